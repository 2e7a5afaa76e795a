/* The choice of methods: shell/methods.ts. Their names are the core's. */
export const methods = {
  group: 'Methods', all: 'All methods', search: 'order 4, symplectic, Yoshida …',
  more: (count: string) => `${count} more`,
  found: (count: number) => (count === 1 ? '1 method' : `${count} methods`),
  most: (most: string) => `${most} methods at once are as many as a picture can hold.`,
  /** What is said of a method, and what it is found by; evaluations of the force a step, 0 of an implicit one. */
  told: (order: number, symplectic: boolean, reversible: boolean, family: string, evaluations: number) => [order ? `order ${order}` : '', symplectic ? 'symplectic' : '', reversible ? 'reversible' : '', family,
    evaluations > 0 ? `${evaluations} evaluation${evaluations === 1 ? '' : 's'} a step` : 'implicit'].filter(Boolean).join(', '),
  /** In a search this word and the number behind it are one thing. */
  order: 'order',
  /** The method that the library chooses for an accuracy: what it is called, '': not known yet; why. */
  auto: (label: string) => (label ? `auto: ${label}` : 'auto'), autoTitle: (why: string) => (why ? `Chosen for the accuracy: ${why}` : 'Chooses the method for the accuracy'),
  refused: (reason: string, hint: string) => (hint ? `${reason}; ${hint}` : reason),
} as const;
