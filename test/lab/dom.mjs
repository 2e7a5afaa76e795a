/* So much of a browser's document that panels can be made and drawn without one: elements that keep their children and attributes, canvases whose letters are kept.
 *
 * Invariant: what is asked for in the next frame is done by `frame()`, and nothing by itself; an element has the width that `size` was set to.
 */
export const size = { width: 1000, height: 800 };
let asked = [];
class Fake {
  constructor(tag) { Object.assign(this, { localName: tag, children: [], attributes: {}, dataset: {}, style: { setProperty() {} }, letters: [], own: '' }); this.classList = { toggle() {}, add() {}, remove() {}, contains: () => false }; }
  append(...all) { for (const child of all) if (child !== null) { this.children.push(child); if (child instanceof Fake) child.parentElement = this; } }
  replaceChildren(...all) { this.children = []; this.own = ''; this.append(...all); }
  setAttribute(name, value) { this.attributes[name] = String(value); if (name === 'class') this.className = value; if (name === 'value') this.value = value; }
  getAttribute(name) { return this.attributes[name] ?? null; }
  removeAttribute(name) { delete this.attributes[name]; }
  toggleAttribute() {}
  get textContent() { return this.own + this.children.map((child) => (typeof child === 'string' ? child : child.textContent)).join(''); }
  set textContent(text) { this.children = []; this.own = String(text); }
  get childElementCount() { return this.children.length; }
  get childNodes() { return this.children; }
  get lastChild() { return this.children.at(-1) ?? null; }
  get lastElementChild() { return this.lastChild; }
  get options() { return this.children; }
  get clientWidth() { return size.width; }
  get clientHeight() { return size.height; }
  get scrollWidth() { return 100; }
  remove() { const all = this.parentElement?.children, at = all?.indexOf(this) ?? -1; if (at >= 0) all.splice(at, 1); }
  contains() { return false; }
  closest() { return null; }
  matches() { return false; }
  focus() {}
  scrollIntoView() {}
  addEventListener() {}
  removeEventListener() {}
  dispatchEvent() { return true; }
  getBoundingClientRect() { return { left: 0, top: 0, width: size.width, height: size.height }; }
  *all() { yield this; for (const child of this.children) if (child instanceof Fake) yield* child.all(); }
  querySelectorAll(selector) { return [...this.all()].filter((e) => e !== this && (selector.startsWith('.') ? e.className?.split(' ').includes(selector.slice(1)) : e.localName === selector)); }
  querySelector(selector) { return this.querySelectorAll(selector)[0] ?? null; }
  getContext() {
    const kept = this;
    return this.context ??= new Proxy({ measureText: (text) => ({ width: 7 * text.length }), clearRect() { kept.letters = []; }, fillText(text, x, y) { kept.letters.push({ text, x, y }); } }, { get: (of, name) => of[name] ?? (() => undefined), set: (of, name, value) => { of[name] = value; return true; } });
  }
}
const root = new Fake('html');
Object.assign(globalThis, {
  window: globalThis, innerHeight: 800, innerWidth: 1280, devicePixelRatio: 1, Node: Fake, Element: Fake, HTMLElement: Fake, HTMLInputElement: class extends Fake {},
  document: { createElement: (tag) => new Fake(tag), createElementNS: (_, tag) => new Fake(tag), createTextNode: (text) => text, getElementById: () => null, addEventListener() {}, documentElement: root, body: root, fonts: { ready: Promise.resolve() } },
  Option: class extends Fake { constructor(text, value) { super('option'); this.textContent = text; this.value = value; } },
  CustomEvent: class {}, matchMedia: () => ({ matches: false, addEventListener() {} }), getComputedStyle: () => ({ getPropertyValue: () => '#101010', fontSize: '16px', fontFamily: 'sans' }),
  requestAnimationFrame: (act) => asked.push(act), cancelAnimationFrame() {},
  ResizeObserver: class { constructor(act) { this.act = act; } observe(of) { this.act([{ target: of }]); } disconnect() {} },
  IntersectionObserver: class { constructor(act) { this.act = act; } observe() { this.act([{ isIntersecting: true }]); } disconnect() {} },
});
/** Does what was asked for in the next frame. */
export function frame() { const now = asked; asked = []; for (const act of now) act(performance.now()); }
