/* THE METHODS. Every method is a row: its card, then its coefficients; the texts in step/ run them.
 *
 * Invariant: test/laws.c proves of every row what its card states: order, symplecticity, reversibility, evaluations,
 * stability limit. A coefficient with a closed form is written as one, K(7.0) / K(24.0). The others have as many digits
 * as are known: 26 for Kahan-Li, 15 to 16 for Blanes-Moan and PEFRL, whose papers print no more. Every digit matters:
 * the laws allow half a unit in the last place that a K(…) prints. Keys are those of doc/references.bib.
 */
#include "core/rows.h"

#include <math.h>

#define CARD(name_, aliases_, family_, order_, stages_, evaluations_, forces_, symplectic_, reversible_, limit_) \
    .name = name_, .aliases = aliases_, .family = family_, .order = order_, .stages = stages_,                   \
    .evaluations = evaluations_, .forces = MOTUS_FORCES_##forces_, .symplectic = symplectic_,                    \
    .reversible = reversible_, .stability_limit = limit_

/* A list of coefficients. */
#define C(...) \
    (const coef[]) { __VA_ARGS__ }

/* Newmark's row, twice: only with gamma = 1/2 is it of order 2 and reversible. */
#define NEWMARK(order_, reversible_, use_)                                                                            \
    {                                                                                                                 \
        .card = {CARD("newmark", "newmark-beta", "implicit", order_, 2, 0, XVT, 0, reversible_, INFINITY),            \
                 .title = "Newmark", .cite = "Newmark59",                                                             \
                 .formula =                                                                                           \
                     "x₁ = x + h v + h² ((1/2 − β) a + β a₁),   v₁ = v + h ((1 − γ) a + γ a₁),   a₁ = a(x₁, v₁, t₁)", \
                 .use = use_},                                                                                        \
        .family = IMPLICIT, .arguments = 2, .newmark = true                                                           \
    }

/* clang-format off: a table. */
const row methods_table[] = {
    /* The two-step methods: the recurrence between positions; velocities are formed at the same time as positions. */
    {.card =
         {CARD("verlet", "stormer-verlet stormer störmer-verlet störmer", "two-step", 2, 1, 1, XVT, 1, 1, 2.0),
          .title = "Verlet", .cite = "Verlet67, HLW03",
          .formula = "d₁ = h v₀ + h²/2 a₀;   x += d;   d += h² a(x, v, t);   v = (d + h²/2 a)/h\n"
                     "velocity terms: the implicit kick δ of d solves δ = h² a(x, (d + δ/2)/h, t)",
          .use =
              "The first choice: one evaluation a step, velocity terms included, and the summed form loses nothing to\n"
              "round-off at small steps."},
     .family = VERLET},
    {.card = {CARD("verlet-literal", "stormer-literal", "two-step", 2, 1, 1, XVT, 1, 1, 2.0),
              .title = "Verlet, literal", .cite = "Verlet67",
              .formula = "x₁ = x₀ + h v₀ + h²/2 a₀;   xₙ₊₁ = 2 xₙ − xₙ₋₁ + h² a(xₙ, (xₙ₊₁ − xₙ₋₁)/2h, tₙ)",
              .use =
                  "To reproduce numbers from programs that write the recurrence this way. It loses digits like ε/h²;\n"
                  "verlet is the same method without that loss."},
     .family = LITERAL,
     .uniform = true},
    {.card = {CARD("beeman", "", "two-step", 2, 1, 1, XT, 0, 0, 2.0), .title = "Beeman", .cite = "Beeman76",
              .formula = "xₙ₊₁ = xₙ + h vₙ + h²/6 (4 aₙ − aₙ₋₁);   vₙ₊₁ = vₙ + h/6 (2 aₙ₊₁ + 5 aₙ − aₙ₋₁);   a₋₁ = a₀",
              .use = "Verlet's positions with somewhat better velocities; known from molecular dynamics."},
     .family = BEEMAN},

    /* Splitting: kicks v += b h a(x, t) and drifts x += d h v in turn. */
    {.card = {CARD("symplectic-euler", "euler-cromer semi-implicit-euler", "splitting", 1, 1, 1, XT, 1, 0, 2.0),
              .title = "symplectic Euler", .cite = "Cromer81, deVogelaere56, HLW06 I.1.2",
              .formula = "v += h a(x, t);   x += h v",
              .use = "The smallest change to Euler's method that keeps the energy; for teaching."},
     .family = SPLITTING,
     .splitting = {1, C(K(1.0)), C(K(1.0))}},
    {.card = {CARD("symplectic-euler-adjoint", "drift-kick-euler", "splitting", 1, 1, 1, XT, 1, 0, 2.0),
              .title = "symplectic Euler, adjoint", .cite = "deVogelaere56, HLW06 I.1.2",
              .formula = "x += h v;   v += h a(x, t + h)",
              .use = "The adjoint of symplectic-euler: the two in turn, with half steps, are velocity-verlet."},
     .family = SPLITTING,
     .splitting = {2, C(K(0.0), K(1.0)), C(K(1.0), K(0.0))}},
    {.card = {CARD("velocity-verlet", "kick-drift-kick kdk", "splitting", 2, 2, 1, XT, 1, 1, 2.0),
              .title = "velocity Verlet", .cite = "Swope82, HLW03",
              .formula = "v += h/2 a(x, t);   x += h v;   v += h/2 a(x, t + h)",
              .use = "Verlet's method as a one-step map; the closing kick of a step and the opening one of the next\n"
                     "are one."},
     .family = SPLITTING,
     .splitting = {2, C(K(0.5), K(0.5)), C(K(1.0), K(0.0))}},
    {.card = {CARD("leapfrog", "drift-kick-drift dkd position-verlet", "splitting", 2, 1, 1, XT, 1, 1, 2.0),
              .title = "leapfrog", .cite = "HLW03", .formula = "x += h/2 v;   v += h a(x, t + h/2);   x += h/2 v",
              .use =
                  "As velocity-verlet, with the force in the middle of the step; the base of the compositions below."},
     .family = SPLITTING,
     .splitting = {2, C(K(0.0), K(1.0)), C(K(0.5), K(0.5))}},
    {.card = {CARD("ruth3", "", "splitting", 3, 3, 3, XT, 1, 0, 2.5074811709523554), .title = "Ruth 3",
              .cite = "Ruth83", .formula = "kicks 7/24, 3/4, −1/24;   drifts 2/3, −2/3, 1",
              .use = "The first symplectic method above order 2; of historical interest."},
     .family = SPLITTING,
     .splitting = {3, C(K(7.0) / K(24.0), K(3.0) / K(4.0), K(-1.0) / K(24.0)),
                   C(K(2.0) / K(3.0), K(-2.0) / K(3.0), K(1.0))}},
    {.card = {CARD("forest-ruth", "yoshida4 candy-rozmus", "splitting", 4, 3, 3, XT, 1, 1, 1.5734019474345401),
              .title = "Forest–Ruth", .cite = "ForestRuth90 eq. 4.8, Yoshida90",
              .formula = "leapfrog steps of w h, (1 − 2w) h, w h;   w = 1/(2 − ∛2)",
              .use = "The classical order 4; mclachlan4 and blanes-moan4 are far more accurate at equal work."},
     .family = SPLITTING,
     .composition = {3,
                     C(K(1.351207191959657634047687808971460826922), K(-1.702414383919315268095375617942921653844))}},
    {.card = {CARD("pefrl", "omelyan4", "splitting", 4, 4, 4, XT, 1, 1, 2.9894495459067291), .title = "PEFRL",
              .cite = "OMF02", .formula = "drifts ξ, χ, 1 − 2(χ + ξ), χ, ξ;   kicks (1 − 2λ)/2, λ, λ, (1 − 2λ)/2",
              .use = "Order 4 with a far smaller error than forest-ruth's at equal work."},
     .family = SPLITTING,
     .splitting = {5,
                   C(K(0.0), K(0.7123418310626054), K(-0.2123418310626054), K(-0.2123418310626054),
                     K(0.7123418310626054)),
                   C(K(0.1786178958448091), K(-0.06626458266981849), K(0.77529337365001878), K(-0.06626458266981849),
                     K(0.1786178958448091))}},
    {.card = {CARD("mclachlan4", "mclachlan-sb3a", "splitting", 4, 5, 5, XT, 1, 1, 2.9218392391961706),
              .title = "McLachlan 4", .cite = "McLachlan95",
              .formula = "six drifts and five kicks, symmetric, for kinetic energies quadratic in v",
              .use = "Order 4 for long runs, as accurate as pefrl."},
     .family = SPLITTING,
     .splitting = {6,
                   C(K(0.0), K(-0.04109589041095890411), K(0.28813559322033898305), K(0.50592059438123984212),
                     K(0.28813559322033898305), K(-0.04109589041095890411)),
                   C(K(0.4051886183952522772), K(-0.287144040816524089), K(0.3819554224212718118),
                     K(0.3819554224212718118), K(-0.287144040816524089), K(0.4051886183952522772))}},
    {.card = {CARD("suzuki4", "", "splitting", 4, 5, 5, XT, 1, 1, 2.7209745385601497), .title = "Suzuki 4",
              .cite = "Suzuki90", .formula = "leapfrog steps of w h, w h, (1 − 4w) h, w h, w h;   w = 1/(4 − ∛4)",
              .use = "Order 4 with smaller substeps than forest-ruth's; robust on rough motions."},
     .family = SPLITTING,
     .composition = {5, C(K(0.4144907717943757371423540628607614957118), K(0.4144907717943757371423540628607614957118),
                          K(-0.6579630871775029485694162514430459828471))}},
    {.card = {CARD("blanes-moan4", "srkn6 blanes-moan-srkn6", "splitting", 4, 7, 6, XT, 1, 1, 3.1634650665581867),
              .title = "Blanes–Moan 4", .cite = "BM02",
              .formula =
                  "seven kicks and six drifts, symmetric, beginning with a kick; a Runge-Kutta-Nyström splitting",
              .use = "The best order 4 here at equal work."},
     .family = SPLITTING,
     .splitting = {7,
                   C(K(0.0829844064174052), K(0.396309801498368), K(-0.0390563049223486), K(0.1195241940131508),
                     K(-0.0390563049223486), K(0.396309801498368), K(0.0829844064174052)),
                   C(K(0.245298957184271), K(0.60487266571108), K(-0.350171622895351), K(-0.350171622895351),
                     K(0.60487266571108), K(0.245298957184271), K(0.0))}},
    {.card = {CARD("yoshida6", "", "splitting", 6, 7, 7, XT, 1, 1, 2.2690579963976594), .title = "Yoshida 6",
              .cite = "Yoshida90 table 1, solution A", .formula = "seven leapfrog steps of w₁ h … w₄ h … w₁ h",
              .use = "The textbooks' order 6; blanes-moan6 is far more accurate at equal work."},
     .family = SPLITTING,
     .compensated = true,
     .composition = {7,
                     C(K(0.7845136104775572638194976338663498757768), K(0.2355732133593581336847931829785346016865),
                       K(-1.177679984178871006946415680964315734639), K(1.315186320683911218884249728238862514352))}},
    {.card = {CARD("kahan-li6", "", "splitting", 6, 9, 9, XT, 1, 1, 2.532627388334297), .title = "Kahan–Li 6",
              .cite = "KahanLi97", .formula = "nine leapfrog steps, symmetric",
              .use = "Order 6 for any separable system."},
     .family = SPLITTING,
     .compensated = true,
     .composition = {9, C(K(0.39216144400731413927925056), K(0.33259913678935943859974864),
                          K(-0.70624617255763935980996482), K(0.08221359629355080023149045),
                          K(0.79854399093482996339895035))}},
    {.card = {CARD("blanes-moan6", "srkn11 blanes-moan-srkn11", "splitting", 6, 12, 11, XT, 1, 1, 3.1414310877528084),
              .title = "Blanes–Moan 6", .cite = "BM02",
              .formula =
                  "twelve kicks and eleven drifts, symmetric, beginning with a kick; a Runge-Kutta-Nyström splitting",
              .use = "Order 6 for long, accurate runs of x'' = a(x, t)."},
     .family = SPLITTING,
     .compensated = true,
     .splitting = {12,
                   C(K(0.0414649985182624), K(0.198128671918067), K(-0.0400061921041533), K(0.0752539843015807),
                     K(-0.0115113874206879), K(0.2366699247869311), K(0.2366699247869311), K(-0.0115113874206879),
                     K(0.0752539843015807), K(-0.0400061921041533), K(0.198128671918067), K(0.0414649985182624)),
                   C(K(0.123229775946271), K(0.290553797799558), K(-0.127049212625417), K(-0.246331761062075),
                     K(0.357208872795928), K(0.20477705429147), K(0.357208872795928), K(-0.246331761062075),
                     K(-0.127049212625417), K(0.290553797799558), K(0.123229775946271), K(0.0))}},
    {.card = {CARD("blanes-moan6-14", "srkn14 blanes-moan-srkn14", "splitting", 6, 14, 14, XT, 1, 1,
                   3.1409250826052366),
              .title = "Blanes–Moan 6, 14", .cite = "BM02",
              .formula = "fifteen drifts and fourteen kicks, symmetric, beginning with a drift; "
                         "a Runge-Kutta-Nyström splitting",
              .use = "Order 6 with the smallest error constant here."},
     .family = SPLITTING,
     .compensated = true,
     .splitting = {15,
                   C(K(0.0), K(0.09171915262446165), K(0.183983170005006), K(-0.05653436583288827),
                     K(0.004914688774712854), K(0.143761127168358), K(0.328567693746804), K(-0.19641146648645423),
                     K(-0.19641146648645423), K(0.328567693746804), K(0.143761127168358), K(0.004914688774712854),
                     K(-0.05653436583288827), K(0.183983170005006), K(0.09171915262446165)),
                   C(K(0.0378593198406116), K(0.102635633102435), K(-0.0258678882665587), K(0.314241403071447),
                     K(-0.130144459517415), K(0.106417700369543), K(-0.00879424312851058), K(0.2073050690568954),
                     K(-0.00879424312851058), K(0.106417700369543), K(-0.130144459517415), K(0.314241403071447),
                     K(-0.0258678882665587), K(0.102635633102435), K(0.0378593198406116))}},
    {.card = {CARD("yoshida8", "", "splitting", 8, 15, 15, XT, 1, 1, 2.3565081394342591), .title = "Yoshida 8",
              .cite = "Yoshida90 table 2, solution D", .formula = "fifteen leapfrog steps, symmetric",
              .use = "The textbooks' order 8; kahan-li8 is far more accurate at equal work."},
     /* The paper prints 15 digits, of which 13 satisfy the order conditions; Newton's method gives the others. */
     .family = SPLITTING,
     .compensated = true,
     .composition = {15,
                     C(K(0.9148442462297915667487934898475096045181), K(0.2536933365662113541461460206899420760977),
                       K(-1.444852236860605157694730657537390354956), K(-0.1582406353680501752040667767597542477554),
                       K(1.938139137622525986579186487443641760954), K(-1.960610232975310807607633376399663640792),
                       K(0.102799849391796440698115131601225862911), K(1.708453070787281584668379362228977878047))}},
    {.card = {CARD("kahan-li8", "", "splitting", 8, 17, 17, XT, 1, 1, 3.0964386800007322), .title = "Kahan–Li 8",
              .cite = "KahanLi97", .formula = "seventeen leapfrog steps, symmetric",
              .use = "Positions to round-off where the force is smooth; the most accurate row here at equal work."},
     .family = SPLITTING,
     .compensated = true,
     .composition = {17, C(K(0.13020248308889008087881763), K(0.56116298177510838456196441),
                           K(-0.3894749626448472864080786), K(0.15884190655515560089621075),
                           K(-0.39590389413323757733623154), K(0.18453964097831570709183254),
                           K(0.25837438768632204729397911), K(0.29501172360931029887096624),
                           K(-0.60550853383003451169892108))}},
    {.card = {CARD("boris", "", "splitting", 2, 1, 1, XVT, 0, 1, 2.0), .title = "Boris", .cite = "Boris70, Qin13",
              .formula = "x += h/2 v;   v' = v + h a(x, (v + v')/2, t + h/2);   x += h/2 v'\n"
                         "for a = E + v × B the kick is half a kick by E, the Boris rotation, half a kick: "
                         "the Cayley form of the rotation",
              .use =
                  "Charged particles: keeps phase-space volume, and energy where E = 0; stable beyond the gyration."},
     .family = SPLITTING,
     .gyroscopic = true,
     .splitting = {2, C(K(0.0), K(1.0)), C(K(0.5), K(0.5))}},

    /* Explicit Runge-Kutta. */
    {.card = {CARD("explicit-euler", "euler forward-euler rk1", "runge-kutta", 1, 1, 1, XVT, 0, 0, 0.0),
              .title = "explicit Euler", .cite = "Euler1768", .formula = "x₁ = x + h v;   v₁ = v + h a(x, v, t)",
              .use = "To see what goes wrong: the energy grows without bound."},
     .family = RUNGE_KUTTA,
     .tableau = {1, C(K(0.0)), NULL, C(K(1.0))}},
    {.card = {CARD("midpoint", "rk2 explicit-midpoint modified-euler", "runge-kutta", 2, 2, 2, XVT, 0, 0, 0.0),
              .title = "midpoint (RK2)", .cite = "Runge1895",
              .formula = "half a step of Euler's method gives the slope for the whole step",
              .use = "Order 2 for any force, over short times."},
     .family = RUNGE_KUTTA,
     .tableau = {2, C(K(0.0), K(0.5)), C(K(0.5)), C(K(0.0), K(1.0))}},
    {.card = {CARD("heun", "improved-euler explicit-trapezoid", "runge-kutta", 2, 2, 2, XVT, 0, 0, 0.0),
              .title = "Heun", .cite = "Heun1900",
              .formula = "the mean of the slopes at the start and at Euler's end point", .use = "As midpoint."},
     .family = RUNGE_KUTTA,
     .tableau = {2, C(K(0.0), K(1.0)), C(K(1.0)), C(K(0.5), K(0.5))}},
    {.card = {CARD("ralston", "ralston2", "runge-kutta", 2, 2, 2, XVT, 0, 0, 0.0), .title = "Ralston",
              .cite = "Ralston62", .formula = "abscissae 0, 2/3;   weights 1/4, 3/4",
              .use = "Order 2 with the smallest bound of the local error."},
     .family = RUNGE_KUTTA,
     .tableau = {2, C(K(0.0), K(2.0) / K(3.0)), C(K(2.0) / K(3.0)), C(K(0.25), K(0.75))}},
    {.card = {CARD("rk3", "kutta3", "runge-kutta", 3, 3, 3, XVT, 0, 0, 1.7320508075688773), .title = "RK3",
              .cite = "Kutta1901", .formula = "abscissae 0, 1/2, 1;   weights 1/6, 2/3, 1/6 (Simpson's rule)",
              .use = "Order 3 for any force."},
     .family = RUNGE_KUTTA,
     .tableau = {3, C(K(0.0), K(0.5), K(1.0)), C(K(0.5), K(-1.0), K(2.0)),
                 C(K(1.0) / K(6.0), K(2.0) / K(3.0), K(1.0) / K(6.0))}},
    {.card = {CARD("rk4", "kutta4 runge-kutta", "runge-kutta", 4, 4, 4, XVT, 0, 0, 2.8284271247461901), .title = "RK4",
              .cite = "Kutta1901, HNW93 II.1 table 1.2",
              .formula = "abscissae 0, 1/2, 1/2, 1;   weights 1/6, 1/3, 1/3, 1/6",
              .use = "The all-purpose method for short and middle times; energy decays slowly."},
     .family = RUNGE_KUTTA,
     .tableau = {4, C(K(0.0), K(0.5), K(0.5), K(1.0)), C(K(0.5), K(0.0), K(0.5), K(0.0), K(0.0), K(1.0)),
                 C(K(1.0) / K(6.0), K(1.0) / K(3.0), K(1.0) / K(3.0), K(1.0) / K(6.0))}},
    {.card = {CARD("rk4-38", "three-eighths rk38 kutta38", "runge-kutta", 4, 4, 4, XVT, 0, 0, 2.8284271247461901),
              .title = "RK4, 3/8", .cite = "Kutta1901, HNW93 II.1 table 1.2",
              .formula = "abscissae 0, 1/3, 2/3, 1;   weights 1/8, 3/8, 3/8, 1/8",
              .use = "As rk4, with other error terms; which is better depends on the problem."},
     .family = RUNGE_KUTTA,
     .tableau = {4, C(K(0.0), K(1.0) / K(3.0), K(2.0) / K(3.0), K(1.0)),
                 C(K(1.0) / K(3.0), K(-1.0) / K(3.0), K(1.0), K(1.0), K(-1.0), K(1.0)),
                 C(K(1.0) / K(8.0), K(3.0) / K(8.0), K(3.0) / K(8.0), K(1.0) / K(8.0))}},

    /* Implicit: collocation at the Gauss nodes, and Newmark. */
    NEWMARK(2, 1,
            "Structural dynamics. newmark(β, γ), by default (1/4, 1/2), which is stable at every step and keeps the "
            "energy of\n"
            "linear systems; (0, 1/2) is velocity-verlet with velocity terms; γ > 1/2 damps and drops to order 1."),
    {.card = {CARD("implicit-midpoint", "gauss2", "implicit", 2, 1, 0, XVT, 1, 1, INFINITY),
              .title = "implicit midpoint", .cite = "HLW06 II.1.3",
              .formula = "the slope is taken in the middle of the step, at the mean of its two ends",
              .use = "Stable at every step; keeps quadratic invariants, velocity terms included."},
     .family = IMPLICIT,
     .tableau = {1, C(K(0.5)), C(K(0.5)), C(K(1.0))}},
    {.card = {CARD("gauss4", "gauss-legendre4", "implicit", 4, 2, 0, XVT, 1, 1, INFINITY), .title = "Gauss 4",
              .cite = "Butcher64, HLW06 II.1.3", .formula = "collocation at the two Gauss nodes 1/2 ∓ √3/6",
              .use = "Symplectic and reversible at order 4 for every force; stable at every step."},
     .family = IMPLICIT,
     .tableau = {2, C(K(0.21132486540518711774542560974902127218), K(0.78867513459481288225457439025097872782)),
                 C(K(0.25), K(-0.038675134594812882254574390250978727824), K(0.53867513459481288225457439025097872782),
                   K(0.25)),
                 C(K(0.5), K(0.5))}},
    {.card = {CARD("gauss6", "gauss-legendre6", "implicit", 6, 3, 0, XVT, 1, 1, INFINITY), .title = "Gauss 6",
              .cite = "Butcher64, HLW06 II.1.3", .formula = "collocation at the three Gauss nodes 1/2, 1/2 ∓ √15/10",
              .use = "Order 6 for every force; the reference of choice where no exact motion is known."},
     .family = IMPLICIT,
     .compensated = true,
     .tableau = {3, C(K(0.11270166537925831148207346002176003892), K(0.5), K(0.88729833462074168851792653997823996108)),
                 C(K(5.0) / K(36.0), K(-0.0359766675249389034563954710966044185),
                   K(0.0097894440153083260495800422294755685278), K(0.30026319498086459243802494721315553934),
                   K(2.0) / K(9.0), K(-0.022485417203086814660247169435377761562),
                   K(0.26798833376246945172819773554830220925), K(0.48042111196938334790083991554104886294),
                   K(5.0) / K(36.0)),
                 C(K(5.0) / K(18.0), K(4.0) / K(9.0), K(5.0) / K(18.0))}},
    {.card = {CARD("gauss8", "gauss-legendre8", "implicit", 8, 4, 0, XVT, 1, 1, INFINITY), .title = "Gauss 8",
              .cite = "Butcher64, HLW06 II.1.3", .formula = "collocation at the four Gauss nodes",
              .use = "Order 8 for every force."},
     .family = IMPLICIT,
     .compensated = true,
     .tableau = {4,
                 C(K(0.069431844202973712388026755553595247452), K(0.3300094782075718675986671204483776564),
                   K(0.6699905217924281324013328795516223436), K(0.93056815579702628761197324444640475255)),
                 C(K(0.086963711284363464343265987305499851809), K(-0.026604180084998793313385130476953109326),
                   K(0.012627462689404724515056880574618093566), K(-0.0035551496857956831569109818495695885963),
                   K(0.18811811749986807165068554508717116006), K(0.16303628871563653565673401269450014819),
                   K(-0.027880428602470895224151106418997410738), K(0.0067355005945381555153986690857037588899),
                   K(0.16719192197418877317113330552529594473), K(0.35395300603374396653761913180799770712),
                   K(0.16303628871563653565673401269450014819), K(-0.014190694931141142964153570476171456439),
                   K(0.17748257225452261184344295646056929221), K(0.31344511474186834679841114481438220282),
                   K(0.35267675751627186462685315586595340571), K(0.086963711284363464343265987305499851809)),
                 C(K(0.17392742256872692868653197461099970362), K(0.32607257743127307131346802538900029638),
                   K(0.32607257743127307131346802538900029638), K(0.17392742256872692868653197461099970362))}},

    {.card = {CARD("exact", "closed-form", "exact", 0, 0, 0, XVT, 1, 1, INFINITY), .title = "exact", .cite = "",
              .formula = "the model's own exact line; or x = x₀ + v₀ τ + a τ²/2 where the acceleration is constant",
              .use = "The exact motion, where it is known: no error but round-off."},
     .family = EXACT},
};
/* clang-format on */
const size_t methods_count = sizeof methods_table / sizeof *methods_table;

const row methods_newmark_damped =
    NEWMARK(1, 0, "Newmark's method with γ other than 1/2: it damps high frequencies (γ > 1/2) and is of order 1.");
