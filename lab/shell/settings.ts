/* Step and end. Invariant: what the field shows is what the reader typed; what is wrong with it is said under it, and the last good picture stays. */
import type { LiveStore } from '../state';
import { button, el, icon, say } from '../dom';
import { compact, normal, short } from './number';
import { logPosition, logValue } from './range';

const positions = 300;

export function settings(store: LiveStore): HTMLElement {
  const step = el('input', { id: 'step', type: 'text', inputmode: 'text', autocomplete: 'off', spellcheck: 'false', class: 'number', 'aria-describedby': 'step-message' });
  const until = el('input', { id: 'until', type: 'text', inputmode: 'text', autocomplete: 'off', spellcheck: 'false', class: 'number', 'aria-describedby': 'until-message' });
  const slider = el('input', { type: 'range', min: 0, max: positions, step: 1, 'aria-label': 'Time step h, slider' });
  const stepMessage = el('p', { id: 'step-message', class: 'message', role: 'status' }), untilMessage = el('p', { id: 'until-message', class: 'message', role: 'status' });
  const steps = el('p', { class: 'quiet steps' });
  const resetOf = (key: 'step' | 'until', field: HTMLInputElement): HTMLButtonElement =>
    button('Reset', () => { store.change(key === 'step' ? { step: '' } : { until: '' }); empty[key] = ''; field.focus(); refresh(true); }, { class: 'icon-button reset', 'aria-label': `${key === 'step' ? 'Time step' : 'End'}: back to the model’s` }, icon('M5 12a7 7 0 1 1 2 5M5 18v-5h5'));
  const resetStep = resetOf('step', step), resetUntil = resetOf('until', until);
  const element = el('fieldset', { class: 'settings' }, el('legend', {}, 'Time'),
    el('div', { class: 'row' }, el('label', { for: 'step' }, 'Step h'), slider, step, resetStep, stepMessage),
    el('div', { class: 'row' }, el('label', { for: 'until' }, 'End t'), el('span', { class: 'spring' }), until, resetUntil, untilMessage), steps);
  const empty = { step: '', until: '' };
  let low = 1e-3, high = 1, last = '';

  const own = (key: 'step' | 'until'): string => {
    const value = store.description?.settings[key];
    return value === null || value === undefined ? '' : short(value, 15);
  };
  const brief = (key: 'step' | 'until'): string => (own(key).length > 9 ? compact(Number(own(key))) : own(key));
  /** A slider's ends belong to the model, not to the state: they do not move under the reader's hand. */
  function limits(): void {
    const { settings: model } = store.description ?? {};
    if (!model || model.step === null) return;
    const span = model.until === null ? 100 * model.step : Math.abs(model.until - model.start);
    low = Math.max(model.step / 50, span / 1e6);
    high = Math.max(Math.min(model.step * 50, span / 2), 2 * low);
  }
  function refresh(force = false): void {
    const { state, trouble, numbers } = store;
    if (force || document.activeElement !== step) step.value = state.step || brief('step');
    if (force || document.activeElement !== until) until.value = state.until || brief('until');
    if (document.activeElement !== step) empty.step = '';
    if (document.activeElement !== until) empty.until = '';
    const wrongStep = empty.step || trouble.step, wrongUntil = empty.until || trouble.until;
    say(stepMessage, wrongStep || trouble.remark);
    say(untilMessage, wrongUntil);
    stepMessage.classList.toggle('mild', wrongStep === '');
    step.setAttribute('aria-invalid', String(wrongStep !== ''));
    until.setAttribute('aria-invalid', String(wrongUntil !== ''));
    for (const [reset, changed] of [[resetStep, state.step !== ''], [resetUntil, state.until !== '']] as const) {
      reset.classList.toggle('shown', changed);
      reset.disabled = !changed;
    }
    if (numbers.step !== null && document.activeElement !== slider) slider.value = String(logPosition(numbers.step, low, high, positions));
    const h = numbers.step ?? store.description?.settings.step;
    slider.setAttribute('aria-valuetext', h === null || h === undefined ? 'none' : short(h, 4));
    const track = store.scene?.solution.tracks[0];
    say(steps, track && !wrongStep && !wrongUntil ? `${track.total.toLocaleString('en').replace(/,/g, '\u202f')} ${track.total === 1 ? 'step' : 'steps'}` : '');
  }
  const typed = (key: 'step' | 'until', field: HTMLInputElement): void => {
    const text = normal(field.value);
    empty[key] = text ? '' : `${key === 'step' ? 'A step is needed' : 'An end is needed'}${own(key) ? `; the model has ${own(key)}` : ''}.`;
    if (text.length > 200) { empty[key] = 'This is too long.'; }
    if (empty[key]) { refresh(); return; }
    store.change(key === 'step' ? { step: text === own('step') ? '' : text } : { until: text === own('until') ? '' : text });
  };
  step.addEventListener('input', () => typed('step', step));
  until.addEventListener('input', () => typed('until', until));
  for (const [key, field] of [['step', step], ['until', until]] as const) {
    field.addEventListener('focus', () => {
      if (store.state[key]) return;
      field.value = own(key);
      field.select();          // as the browser had it before the value changed
    });
    field.addEventListener('blur', () => refresh());
  }
  slider.addEventListener('input', () => {
    const text = short(logValue(slider.valueAsNumber, low, high, positions), 3);
    step.value = text;
    store.change({ step: text === own('step') ? '' : text });
  });
  store.subscribe(what => {
    if (what === 'description' && last !== store.state.text && store.description) { last = store.state.text; limits(); }
    if (what !== 'view' && what !== 'busy') refresh();
  });
  return element;
}
