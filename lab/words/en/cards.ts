/* What the card of a method says of it: lab/theory/cards.ts. */
export const cards = {
  never: 'never stable on an undamped spring', always: 'stable at any step on a spring', below: (limit: string) => `stable for hω < ${limit}`,
  exact: 'no step, no error but rounding',
  order: (order: string) => `order ${order}`,
  implicit: 'solves an equation at each step', evaluations: (count: number) => (count === 1 ? '1 evaluation a step' : `${count} evaluations a step`),
  symplectic: 'symplectic for a force that is a gradient', notSymplectic: 'not symplectic', reversible: 'reversible', notReversible: 'not reversible',
} as const;
