/* A note above what looks closer at a scene: what to try, what to see. A few sentences each; a preset without one has none. Where no lesson answers the
 * question of the scene, its note begins with the answer.
 *
 * Invariant: every number here is the program's, for the model as it stands in models/ (test/lab/notes.test.mjs).
 */
import type { Note } from '../note';

export const notes: Readonly<Record<string, Note>> = {
  'thrown-ball': [[
    'After two seconds one Euler is 1.962 m too high and the other 1.962 m too low, ½ g h t each; halve the step and it is 0.981 m. The midpoint rule is on the green line to the last digit, as under constant gravity the velocity in the ',
    'middle of a step is exactly the mean. The mass changes the energy, but not the path; ', { to: 'thrown-ball-air', label: 'in air' }, ' it does.',
  ]],
  'thrown-ball-air': [[
    'Air takes 1.45 m from the throw: the ball ends at (10.55, 1.09) m and not at (12, 2.08) m. Make it 4 kg heavy, and it comes to (11.81, 1.95) m, nearly as ', { to: 'thrown-ball', label: 'without air' },
    '. The midpoint rule is not exact any more: it misses by 1.5 cm with the step 0.2, by 3.6 mm with 0.1.',
  ]],
  projectile: [[
    'Not for the Eulers: with sixty steps of 0.05 explicit Euler is after three seconds 0.7357 above the green parabola and symplectic Euler 0.7357 below it, and six hundred steps still leave 0.0736. For the midpoint rule and Verlet any number ',
    'is enough, because the acceleration never changes. So this scene cannot tell which method is good: on ',
    { to: 'spring', label: 'the spring' }, ' they differ. Nor can it tell heavy from light: under gravity alone the mass cancels, and m changes the energy but not the path. ',
    { to: 'thrown-ball-air', label: 'With air drag' }, ' it matters.',
  ]],
  'projectile-drag': [[
    'The air took it: the drag lowers the speed all the time, so the ball comes down slower and steeper than it went up. It needs 2.62 s for the 43 m up and goes 53 m far on the way, then 3.25 s and 37 m for the way down, and lands after ',
    { until: '5.87', label: '5.87 s' }, ' with 25 m/s of the 50 m/s that it had. Drag divided by mass is what slows it, so a heavier one flies farther. No formula gives this motion; the green line is a reference, computed with its own error. Back to ',
    { to: 'thrown-ball', label: 'the ball without air' }, '.',
  ]],
  spring: [
    'Here the Eulers part: in the picture of how fast against how far explicit Euler spirals outward, while symplectic Euler stays on a slightly tilted ellipse for ever.',
    ['At a step of ', { step: '1.9', label: '1.9 s' }, ' it still does, and Verlet’s swing stays as well; at ', { step: '2.1', label: '2.1 s' }, ' both grow by a factor of 1.88 at every step, because 2 s is the largest step at which either is stable on this spring.'],
  ],
  'damped-spring': [
    'Each swing is 27 % narrower than the one before, whatever its size, and has 47 % less energy: friction takes a share, so the swing never quite ends.',
    'Set F to 1 and move omega towards omega0 = 2: the steady swing grows, and lags further behind the force.',
    'In the plane of hλ, under “How large may the step be?”, the points now lie to the left of the imaginary axis, where even explicit Euler has a step that is short enough.',
  ],
  pendulum: [
    'Because what pulls it back grows with the sine of the angle, and so less than the angle: at 2 it is 0.909, where a spring would pull with 2. The swing takes 8.35, a third longer than the 6.28 of a small one.',
    'Start at 3.1, nearly upright, and it lingers at the top: a swing takes 21.04.',
    'The energy is kept, so the phase plane should close on itself: see for which methods it does.',
  ],
  resonance: [
    'As far as one likes, if each comes in time. Held still, the push would stretch the spring by 2 cm; given in time with the swing it adds to it each time, and after a minute the mass swings 58 cm to each side. '
    + 'Verlet’s own frequency is 1 % too high with the step 0.5; run that to 700, and its swing comes to no more than 1.93 m, at t = 289, and dies away again, while the true one grows.',
  ],
  'driven-oscillator': [
    'The spring softens, so a wide swing is slower than the drive and falls out of step with it: pushes that fed the swing then brake it. It swells to 0.81 at t = 15, is nearly at rest at t = 34, and begins anew. Raise F from 0.1 to 0.11 and the '
    + 'mass escapes over the hill at |x| = 1.',
    'Verlet ends 7×10⁻⁷ away from the motion at t = 100; halve the step and a quarter of that is left: see “How far off is each?”.',
  ],
  'damped-cubic': [
    'No. The friction puts the velocity into the force, and Verlet’s central difference for it makes the step an equation; as the force is linear in the velocity, the equation is solved in closed form: the formula stands in “How it works”, under '
    + '“Störmer–Verlet”. Half the step leaves a quarter of the error, as without friction: see “What does half the step buy?”.',
    'The first swing to the other side takes 0.40, the fifth 0.84, more than twice as long: the wider the swing, the faster, and the shorter the step that it needs.',
  ],
  'van-der-pol': [
    'Wide swings are braked and small ones fed, and on one closed curve of the phase plane the two balance over a turn. From 0.1 as from 4 the swing comes to 2.02, and a turn to 11.6. The larger mu, the longer it creeps and the faster it jumps.',
    'In the plane of hλ, under “How large may the step be?”, the points run far to the left and back on each turn: raise mu, and explicit methods need ever shorter steps.',
  ],
  kepler: [
    'The true one does: after ten turns and a half Kahan–Li 8 is 2×10⁻¹¹ from where the planet should be. Velocity Verlet and symplectic Euler lose no energy in the long run, but with both the ellipse turns backward, by 0.37° from one far end to the '
    + 'next: a rosette. Explicit Euler leaves at once.',
    'High order pays on a smooth orbit: with 35 700 evaluations of the force for these ten turns and a half velocity Verlet ends 0.0016 away, and Kahan–Li 8 only 2×10⁻¹¹.',
  ],
  comet: [
    'The step. At the far end of its orbit the comet creeps with 0.19 au a year, at the near end it is sixty times as fast, and there a step of two weeks is long. After one turn velocity Verlet is 2.3 au off and RK4 4.6 au; Kahan–Li 8 comes back '
    + 'to 7×10⁻⁶ au. Explicit Euler has thrown the comet out, 211 au away.',
  ],
  arenstorf: [
    'One of 0.0001 of the way to the Moon, 38 km: started so much farther out, the satellite ends 0.76 of that way from where it should. Close to the Moon an error is magnified: one of 10⁻⁸ at the start is 1.4×10⁻⁴ after one turn. '
    + 'Try RK4 with the step 0.0085, and the satellite is lost.',
  ],
  'outer-solar-system': [
    'On the same orbits: after 548 years Jupiter has gone round 46 times, Saturn 18.6, Uranus 6.5, Neptune 3.3 and Pluto 2.3. In steps of 200 days velocity Verlet has Jupiter on its orbit, but 4.4 au from its place; Kahan–Li 8 is off by 7×10⁻⁷ au. '
    + 'Explicit Euler throws the planets outward; symplectic Euler, at the same price, keeps them on orbits much like the true ones.',
  ],
  'three-body-figure-eight': [
    'They can: after a third of the period each mass stands where another one began, to seven digits, and after a whole one each is back at its own start. The motion is stable; a poor method still breaks it: make the step longer and see after how many turns.',
  ],
  chain: [
    'Hardly anywhere, which nobody expected. Started in its longest wave, the chain was to share its energy out among all waves. But by t = 1000 the third wave has 0.3 % of it; run on to 9000, and the first one, down to 97.5 % at t = 4580, has it all back. '
    + 'With the amplitude 2 the third wave has 4 % by t = 1000. Plot E1 and E3.',
  ],
  'charged-particle': [
    'Boris’ method, which turns the velocity by a rotation. Without an electric field, E = 0, the speed across the magnetic field is 1 and should stay so: Boris keeps it to round-off, at any step; RK4 loses 1.4×10⁻⁶ of it by t = 10, and with explicit '
    + 'Euler the charge is 2.7 times as fast by then, on a circle as much wider.',
    'With the model’s electric field, E.x = 0.5, the charge drifts across both fields, and its speed swings between 0.82 and 1.30. What stays is the energy, m |r′|²/2 − q E·r = 0.53125: Boris keeps it to round-off, RK4 loses 1.5×10⁻⁶ by t = 10, '
    + 'and with explicit Euler it is 3.89, and the charge ends with the speed 2.99 in place of 1.26.',
  ],
  'crossed-fields': [
    'On one half of its circle the electric field makes the electron faster, and it turns in a wider arc than on the other: so it drifts sideways, with |E|/B = 1 mm a nanosecond, whatever its charge, mass and start. Boris’ method keeps the energy to the last digits and is '
    + '0.23 mm off after 150 ns; explicit Euler’s arcs widen, and it ends 28 mm away.',
  ],
  'penning-trap': [
    'The electric field holds it along the axis and pushes it away from there; the magnetic field turns that push into a slow circle, whose energy is negative. Here it keeps between 1 and 1.25 from the axis. It is held only while wc is above √2 wz = 2.83.',
  ],
  'bouncing-ball': [
    'Infinitely often, before 4.0637 s: bounce n + 1 follows after four fifths of the time that bounce n took, and such times have a sum. 135 of the bounces can be told from that limit in double precision. A bounce leaves 64 % of the height.',
    'By explicit Euler every flight lasts about one step h longer than it should and ends about g h faster: in steps of 0.125 s the ball comes to rise above its start, and it never comes to rest.',
  ],
  'newtons-cradle': [
    'Because two equal balls that meet exchange their velocities: the push goes from ball to ball, three contacts in the one instant t = 1, and the last ball, which meets none, keeps it. Momentum and energy stay 1 and 1/2.',
  ],
  billiard: [
    'Within 0.4 of the centre. The angle at which it leaves the rim is that at which it came, so that its angular momentum, 0.4, stays, and with it the circle that every chord touches. 55 hits in 100 units of time; all chords take the same 1.833.',
  ],
  'stick-slip': [
    'Because friction holds better than it drags: at rest on the belt up to a pull of 1, in motion with 0.6. The mass rides along until the spring pulls with 1, slips back for 4.9337, and rides again, over and over, with the period 6.533703423. The spring is stretched to '
    + '1.240312 at most.',
  ],
  'kicked-rotor': [
    'Not far from where it is, while the kicks are weak: the section below has a point for every kick, and motions on its closed curves stay on them. Between them some fill an area at random. The last curve from left to right, which no motion crosses, breaks at K = 0.971635. ',
    'Set K to 5 and it wanders as if at random; of where it is after 100 kicks no digit is known.',
  ],
  'double-pendulum': [
    'Within seven seconds. Change the first angle by 0.0001: the lower mass is 1 cm from where it would have been after 4.9 s, 10 cm after 5.6 s and 1 m after 7.0 s. Until then nothing seems to have happened; such a difference grows by a factor e in about a second.',
  ],
  duffing: [
    'Nobody can say for long: the motion is chaotic. Start it 0.0001 farther out, and the two motions are 0.01 apart after 16 units of time, 0.1 after 32, and in different valleys at t = 79; two methods part in the same way, and in double precision nothing holds much beyond '
    + 't = 200.',
    'In the phase plane the shape they draw is the same.',
  ],
  'henon-heiles': [
    'Between the energies 1/12 and 1/6: below, nearly all motions are regular; up to 1/6, where the star can escape, chaos takes over. This start is between the two, with 0.125: begun 0.0001 nearer the centre, it is 0.01 away after 60 units of time and 0.1 after 130. A symplectic '
    + 'method keeps the energy, and with it the answer to the question whether the star may escape.',
  ],
  ueda: [
    'There is, though nothing in the equation is random and still no two turns are alike. Observed once in each period of the force, at t = 2π n, the points (x, x′) fall on one folded figure, the same from every start. '
    + 'Start at x = 3.0001 in place of 3: the two motions are 0.001 apart after 9 units of time, 0.01 after 37 and 0.1 after 96.',
  ],
};

/** The same answers without the numbers of the model's values, for others. Where there is none, the page says that the answer belongs to the example's values. */
export const movedNotes: Readonly<Record<string, Note>> = {
  'bouncing-ball': [
    'Infinitely often, while e is below 1: bounce n + 1 follows after e times the time that bounce n took, and such times have a sum. A bounce leaves e² of the height.',
    'By explicit Euler every flight lasts about one step h longer than it should and ends about g h faster, and the ball never comes to rest.',
  ],
  'newtons-cradle': [
    'Because two equal balls that meet exchange their velocities: the push goes from ball to ball, and the last one, which meets none, keeps it. Momentum and energy stay.',
  ],
  billiard: [
    'Near the centre. The angle at which it leaves the rim is that at which it came, so that its angular momentum stays, and with it the circle that every chord touches. All chords take the same time.',
  ],
  'stick-slip': [
    'Because friction holds better than it drags, while f is below 1: the mass rides along until the spring pulls with 1, slips back, and rides again.',
  ],
  'kicked-rotor': [
    'Not far from where it is, while the kicks are weak: the section below has a point for every kick, and motions on its closed curves stay on them. Between them some fill an area at random. The last curve from left to right, which no motion crosses, breaks at K = 0.971635; '
    + 'far above that it wanders as if at random.',
  ],
};
