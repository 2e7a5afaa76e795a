/* A note above what looks closer at a scene: what to try, what to see. Two to four sentences each; a preset without one has none.
 *
 * Invariant: every number here is the program's, for the model as it stands in models/.
 */
import type { Note } from '../../data';

export const notes: Readonly<Record<string, Note>> = {
  projectile: [[
    'Thrown like this, with g = 9.81 and the step 0.05, explicit Euler is after three seconds 0.7357 above the green parabola and symplectic Euler 0.7357 below it; the midpoint rule and Verlet are exact, because the ',
    'acceleration never changes. So this scene cannot tell which method is good: on ',
    { to: 'spring', label: 'the spring' }, ' they differ. Nor can it tell heavy from light: under gravity alone the mass cancels, and m changes the energy but not the path. ',
    { to: 'thrown-ball-air', label: 'With air drag' }, ' it matters.',
  ]],
  'projectile-drag': [['Drag divided by mass is what slows the ball, so a heavier one flies further. No formula gives this motion; the green line is a reference, computed with its own error. Back to ',
    { to: 'thrown-ball', label: 'the ball without air' }, '.']],
  spring: [
    'Here the Eulers part. Overlay explicit and symplectic Euler and look at the phase plane: one spirals outward, the other stays on a slightly tilted ellipse for ever.',
    'Then choose Verlet and pull the step up past 2: below it the oscillation holds, above it the numbers explode.',
  ],
  'driven-oscillator': [
    'The motion swells and dies away again: the softening spring falls out of step with the drive. Raise F from 0.1 to 0.11 and the mass escapes over the hill at |x| = 1.',
    'Verlet ends 7×10⁻⁷ away from the motion at t = 100; halve the step and a quarter of that is left. Below it is shown how far off it is.',
  ],
  'damped-cubic': [
    'The force depends on the velocity, and Verlet’s central difference for it makes the step an equation; being linear in the velocity, it is solved in closed form. The formula is in the theory, under Störmer–Verlet.',
    'Look at the convergence: the slope is 2, friction and all. The first swings are fast and need a short step; the last ones hardly any.',
  ],
  'damped-spring': [
    'Set F to 1 and move omega towards omega0 = 2: the steady swing grows, and lags further behind the force.',
    'In the plane of hλ, under the question how large the step may be, the points now lie to the left of the imaginary axis, where even explicit Euler has a step that is short enough.',
  ],
  pendulum: [
    'Let it go at theta = 2 and the swing takes a third longer than a small one. Start at 3.1, nearly upright, and it lingers at the top.',
    'The energy is kept, so the phase plane should close on itself: see for which methods it does.',
  ],
  kepler: [
    'The orbit should close. Explicit Euler leaves it at once; symplectic methods keep the energy, but let the ellipse turn slowly, into a rosette.',
    'High order pays on a smooth orbit: with 35 700 evaluations of the force for these ten turns velocity Verlet is off by 0.004, Kahan–Li 8 by 2×10⁻¹¹.',
  ],
  duffing: [
    'The mass hops between two wells at what look like random times. Two methods, or two steps of one, agree for a while and then part for good: the motion is chaotic, and in double precision nothing holds much beyond t = 200.',
    'In the phase plane the shape they draw is the same.',
  ],
  'van-der-pol': [
    'Start where you like, the motion ends on the same closed curve of the phase plane. The larger mu, the longer it creeps and the faster it jumps.',
    'In the plane of hλ the points run far to the left and back on each turn: raise mu, and explicit methods need ever shorter steps.',
  ],
  'double-pendulum': ['Neighbouring motions part by a factor e every second. Change the first angle by 0.0001 and watch for how long nothing seems to have happened.'],
  'henon-heiles': ['Nearly all motions are regular below the energy 1/12; from there to 1/6, where the star can escape, chaos takes over. This start is between the two. A symplectic method keeps the energy, and with it the answer to the question whether the star may escape.'],
  'three-body-figure-eight': ['Three equal masses chase one another along a figure of eight. The motion is stable; a poor method still breaks it: make the step longer and see after how many turns.'],
  arenstorf: ['A closed orbit of four loops, if it is computed well. Near the Moon a small error is magnified enormously: try RK4 with the step 0.0085, and the satellite is lost.'],
  'outer-solar-system': ['Five planets over 548 years, in steps of 200 days. Explicit Euler throws them outward; symplectic Euler, at the same price, keeps them on orbits much like the true ones.'],
  'charged-particle': ['It circles about the magnetic field and drifts across both. Boris’ method turns the velocity by a rotation, so that the circle stays a circle at any step.'],
  'penning-trap': ['A fast circle, an oscillation along the axis, and a slow circle whose energy is negative. The particle is held only while wc is above √2 wz.'],
  chain: ['Started in its longest wave, the chain does not share its energy out among all waves, as was once expected. Plot E1 and E3: the energy wanders to a few waves, and in time comes back.'],
  'thrown-ball': [[
    'After two seconds one Euler is 1.962 m too high and the other 1.962 m too low, ½ g h t each; halve the step and it is 0.981 m. The midpoint rule is on the green line to the last digit, as under constant gravity the velocity in the ',
    'middle of a step is exactly the mean. The mass changes the energy, but not the path; ', { to: 'thrown-ball-air', label: 'in air' }, ' it does.',
  ]],
  'thrown-ball-air': [[
    'Air takes 1.45 m from the throw: the ball ends at (10.55, 1.09) m and not at (12, 2.08) m. Make it 4 kg heavy, and it comes to (11.81, 1.95) m, nearly as ', { to: 'thrown-ball', label: 'without air' },
    '. The midpoint rule is not exact any more: it misses by 1.5 cm with the step 0.2, by 3.6 mm with 0.1.',
  ]],
  resonance: [
    'Held still, the push would stretch the spring by 2 cm. Given in time with the swing it adds to it each time: after a minute the mass swings 60 cm to each side, thirty times as far. Verlet’s own frequency is 1 % too high with the step 0.5; '
    + 'run that to 700, and its swing comes to no more than 1.93 m, at t = 289, and dies away again, while the true one grows.',
  ],
  comet: [
    'At the far end of its orbit the comet creeps with 0.19 au a year, at the near end it is sixty times as fast, and there a step of two weeks is long. After one turn velocity Verlet is 2.3 au off and RK4 4.6 au; Kahan–Li 8 comes back to 7×10⁻⁶ au. '
    + 'Explicit Euler has thrown the comet out, 211 au away.',
  ],
  'crossed-fields': [
    'On one half of its circle the electric field makes the electron faster, and it turns in a wider arc than on the other: so it drifts sideways, with |E|/B = 1 mm a nanosecond, whatever its charge, mass and start. Boris’ method keeps the energy to the last digits and is '
    + '0.23 mm off after 150 ns; explicit Euler’s arcs widen, and it ends 28 mm away.',
  ],
  ueda: [
    'Nothing in the equation is random, and still no two turns are alike. Start at x = 3.0001 in place of 3: the two motions are 0.001 apart after 9 units of time, 0.01 after 37 and 0.1 after 96. '
    + 'Seen once in each period of the force, at t = 2π n, the points (x, x′) fall on one folded figure, the same from every start.',
  ],
};
