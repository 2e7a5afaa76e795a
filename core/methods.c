/* THE METHODS. Every method is a row: its card, then its coefficients; the texts in step/ run them.
 *
 * Invariant: test/laws.c proves of every row what its card states: order, symplecticity, reversibility, evaluations,
 * stability limit. A coefficient with a closed form is written as one, K(7.0) / K(24.0). The others have as many digits
 * as are known: 26 for Kahan-Li, 15 to 16 for Blanes-Moan and PEFRL, whose papers print no more. Every digit matters:
 * the laws allow half a unit in the last place that a K(…) prints. Keys are those of doc/references.bib.
 */
#include "core/rows.h"
#include "core/tables.h"

#include <math.h>

/* between: the order of dense output */
#define CARD_BETWEEN(between_, name_, aliases_, family_, order_, stages_, evaluations_, forces_, symplectic_, \
                     reversible_, limit_)                                                                     \
    .name = name_, .aliases = aliases_, .family = family_, .order = order_, .stages = stages_,                \
    .evaluations = evaluations_, .forces = MOTUS_FORCES_##forces_, .symplectic = symplectic_,                 \
    .reversible = reversible_, .stability_limit = limit_, .dense_order = between_
#define CARD(name, aliases, family, order, ...) CARD_BETWEEN(order, name, aliases, family, order, __VA_ARGS__)

/* Continuous weights. */
#define DENSE(...)  \
    {               \
        __VA_ARGS__ \
    }

/* What the compositions of leapfrog steps do with forces that depend on the velocity. */
#define IMPLICIT_KICKS "\nvelocity terms: each kick takes a at the mean of the velocities before and after it"

/* A list of coefficients. */
#define C(...) \
    (const coef[]) { __VA_ARGS__ }

/* An embedded pair of the lists NAME_… of tables.h, and one of Nyström methods; order: of the embedded method. */
#define PAIR_OF(NAME, stages_, order_, ...)                       \
    .family = RUNGE_KUTTA, .adaptive = true, .compensated = true, \
    .tableau = {.stages = stages_, .order = order_, .c = NAME##_C, .b = NAME##_B, .error = NAME##_ERROR, __VA_ARGS__}
#define PAIR(NAME, ...) PAIR_OF(NAME, __VA_ARGS__, .a = NAME##_A)
#define NYSTROM_PAIR(NAME, ...) PAIR_OF(NAME, __VA_ARGS__, .aa = NAME##_AA, .bb = NAME##_BB, .error_x = NAME##_ERROR_X)

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

/* clang-format off */
/* Coefficients of two rows: with steps of one size, and with steps that follow the time scale of the motion. */
#define VELOCITY_VERLET \
    .splitting = {2, C(K(0.5), K(0.5)), C(K(1.0), K(0.0))}
#define BLANES_MOAN4 \
    .splitting = {7, \
    C(K(0.0829844064174052), K(0.396309801498368), K(-0.0390563049223486), K(0.1195241940131508), \
    K(-0.0390563049223486), K(0.396309801498368), K(0.0829844064174052)), \
    C(K(0.245298957184271), K(0.60487266571108), K(-0.350171622895351), K(-0.350171622895351), \
    K(0.60487266571108), K(0.245298957184271), K(0.0))}
#define BLANES_MOAN6 \
    .splitting = {12, \
    C(K(0.0414649985182624), K(0.198128671918067), K(-0.0400061921041533), K(0.0752539843015807), \
    K(-0.0115113874206879), K(0.2366699247869311), K(0.2366699247869311), K(-0.0115113874206879), \
    K(0.0752539843015807), K(-0.0400061921041533), K(0.198128671918067), K(0.0414649985182624)), \
    C(K(0.123229775946271), K(0.290553797799558), K(-0.127049212625417), K(-0.246331761062075), \
    K(0.357208872795928), K(0.20477705429147), K(0.357208872795928), K(-0.246331761062075), \
    K(-0.127049212625417), K(0.290553797799558), K(0.123229775946271), K(0.0))}
#define KAHAN_LI8 \
    .composition = {17, \
    C(K(0.13020248308889008087881763), K(0.56116298177510838456196441), K(-0.3894749626448472864080786), \
    K(0.15884190655515560089621075), K(-0.39590389413323757733623154), K(0.18453964097831570709183254), \
    K(0.25837438768632204729397911), K(0.29501172360931029887096624), K(-0.60550853383003451169892108))}
const row methods_table[] = {
    /* The two-step methods: the recurrence between positions; velocities are formed at the same time as positions. */
    { .card = { CARD("verlet", "stormer-verlet stormer störmer-verlet störmer", "two-step", 2, 1, 1, XVT, 1, 1, 2.0),
       .title = "Verlet", .cite = "Verlet67, HLW03",
       .formula = "d₁ = h v₀ + h²/2 a₀;   x += d;   d += h² a(x, v, t);   v = (d + h²/2 a)/h\n"
                  "velocity terms: the implicit kick δ of d solves δ = h² a(x, (d + δ/2)/h, t)",
       .use = "The first choice: one evaluation a step, velocity terms included, and the summed form loses nothing to\n"
              "round-off at small steps." },
      .family = VERLET },
    { .card = { CARD("verlet-literal", "stormer-literal", "two-step", 2, 1, 1, XVT, 1, 1, 2.0),
       .title = "Verlet, literal", .cite = "Verlet67",
       .formula = "x₁ = x₀ + h v₀ + h²/2 a₀;   xₙ₊₁ = 2 xₙ − xₙ₋₁ + h² a(xₙ, (xₙ₊₁ − xₙ₋₁)/2h, tₙ)",
       .use = "To reproduce numbers from programs that write the recurrence this way. It loses digits like ε/h²;\n"
              "verlet is the same method without that loss." },
      .family = LITERAL, .uniform = true },
    { .card = { CARD("beeman", "", "two-step", 2, 1, 1, XT, 0, 0, 2.0),
       .title = "Beeman", .cite = "Beeman76",
       .formula = "xₙ₊₁ = xₙ + h vₙ + h²/6 (4 aₙ − aₙ₋₁);   vₙ₊₁ = vₙ + h/6 (2 aₙ₊₁ + 5 aₙ − aₙ₋₁);   a₋₁ = a₀",
       .use = "Verlet's positions with somewhat better velocities; known from molecular dynamics." },
      .family = BEEMAN, .alone = "velocity-verlet" },

    /* Splitting: kicks v += b h a(x, t) and drifts x += d h v in turn. */
    { .card = { CARD("symplectic-euler", "euler-cromer semi-implicit-euler", "splitting", 1, 1, 1, XT, 1, 0, 2.0),
       .title = "symplectic Euler", .cite = "Cromer81, deVogelaere56, HLW06 I.1.2",
       .formula = "v += h a(x, t);   x += h v",
       .use = "The smallest change to Euler's method that keeps the energy of a gradient in a band; for teaching." },
      .family = SPLITTING, .splitting = {1, C(K(1.0)), C(K(1.0))} },
    { .card = { CARD("symplectic-euler-adjoint", "drift-kick-euler", "splitting", 1, 1, 1, XT, 1, 0, 2.0),
       .title = "symplectic Euler, adjoint", .cite = "deVogelaere56, HLW06 I.1.2",
       .formula = "x += h v;   v += h a(x, t + h)",
       .use = "The adjoint of symplectic-euler: the two in turn, with half steps, are velocity-verlet." },
      .family = SPLITTING, .splitting = {2, C(K(0.0), K(1.0)), C(K(1.0), K(0.0))} },
    { .card = { CARD("velocity-verlet", "kick-drift-kick kdk", "splitting", 2, 2, 1, XT, 1, 1, 2.0),
       .title = "velocity Verlet", .cite = "Swope82, HLW03",
       .formula = "v += h/2 a(x, t);   x += h v;   v += h/2 a(x, t + h)",
       .use = "Verlet's method as a one-step map; the closing kick of a step and the opening one of the next\n"
              "are one." },
      .family = SPLITTING, VELOCITY_VERLET },
    { .card = { CARD("leapfrog", "drift-kick-drift dkd position-verlet", "splitting", 2, 1, 1, XVT, 1, 1, 2.0),
       .title = "leapfrog", .cite = "HLW03, HLW06 II.5",
       .formula = "x += h/2 v;   v += h a(x, t + h/2);   x += h/2 v" IMPLICIT_KICKS,
       .use = "As velocity-verlet, with the force in the middle of the step, and for velocity terms too; the base of\n"
              "the compositions below." },
      .family = SPLITTING, .splitting = {2, C(K(0.0), K(1.0)), C(K(0.5), K(0.5))} },
    { .card = { CARD("ruth3", "", "splitting", 3, 3, 3, XT, 1, 0, 2.5074811709523554),
       .title = "Ruth 3", .cite = "Ruth83",
       .formula = "kicks 7/24, 3/4, −1/24;   drifts 2/3, −2/3, 1",
       .use = "The first symplectic method above order 2; of historical interest." },
      .family = SPLITTING, .splitting = {3, C(K(7.0) / K(24.0), K(3.0) / K(4.0), K(-1.0) / K(24.0)),
                       C(K(2.0) / K(3.0), K(-2.0) / K(3.0), K(1.0))} },
    { .card = { CARD("forest-ruth", "yoshida4 candy-rozmus", "splitting", 4, 3, 3, XVT, 1, 1, 1.5734019474345401),
       .title = "Forest–Ruth", .cite = "ForestRuth90 eq. 4.8, Yoshida90",
       .formula = "leapfrog steps of w h, (1 − 2w) h, w h;   w = 1/(2 − ∛2)" IMPLICIT_KICKS,
       .use = "The classical order 4; for x'' = a(x, t) mclachlan4 and blanes-moan4 are far more accurate at equal\n"
              "work. Its substep backward in time is long: under strong friction suzuki4 is safer." },
      .family = SPLITTING, .composition = {3,
        C(K(1.351207191959657634047687808971460826922), K(-1.702414383919315268095375617942921653844))} },
    { .card = { CARD("pefrl", "omelyan4", "splitting", 4, 4, 4, XT, 1, 1, 2.9894495459067291),
       .title = "PEFRL", .cite = "OMF02",
       .formula = "drifts ξ, χ, 1 − 2(χ + ξ), χ, ξ;   kicks (1 − 2λ)/2, λ, λ, (1 − 2λ)/2",
       .use = "Order 4 with a far smaller error than forest-ruth's at equal work." },
      .family = SPLITTING, .splitting = {5,
        C(K(0.0), K(0.7123418310626054), K(-0.2123418310626054), K(-0.2123418310626054), K(0.7123418310626054)),
        C(K(0.1786178958448091), K(-0.06626458266981849), K(0.77529337365001878), K(-0.06626458266981849),
          K(0.1786178958448091))} },
    { .card = { CARD("mclachlan4", "mclachlan-sb3a", "splitting", 4, 5, 5, XT, 1, 1, 2.9218392391961706),
       .title = "McLachlan 4", .cite = "McLachlan95",
       .formula = "six drifts and five kicks, symmetric, for kinetic energies quadratic in v",
       .use = "Order 4 for long runs, as accurate as pefrl." },
      .family = SPLITTING, .splitting = {6,
        C(K(0.0), K(-0.04109589041095890411), K(0.28813559322033898305), K(0.50592059438123984212),
          K(0.28813559322033898305), K(-0.04109589041095890411)),
        C(K(0.4051886183952522772), K(-0.287144040816524089), K(0.3819554224212718118), K(0.3819554224212718118),
          K(-0.287144040816524089), K(0.4051886183952522772))} },
    { .card = { CARD("suzuki4", "", "splitting", 4, 5, 5, XVT, 1, 1, 2.7209745385601497),
       .title = "Suzuki 4", .cite = "Suzuki90",
       .formula = "leapfrog steps of w h, w h, (1 − 4w) h, w h, w h;   w = 1/(4 − ∛4)" IMPLICIT_KICKS,
       .use = "Order 4 with smaller substeps than forest-ruth's; robust on rough motions and under friction." },
      .family = SPLITTING, .composition = {5,
        C(K(0.4144907717943757371423540628607614957118), K(0.4144907717943757371423540628607614957118),
         K(-0.6579630871775029485694162514430459828471))} },
    { .card = { CARD("blanes-moan4", "srkn6 blanes-moan-srkn6", "splitting", 4, 7, 6, XT, 1, 1, 3.1634650665581867),
       .title = "Blanes–Moan 4", .cite = "BM02",
       .formula = "seven kicks and six drifts, symmetric, beginning with a kick; a Runge-Kutta-Nyström splitting",
       .use = "The best order 4 here at equal work." },
      .family = SPLITTING, BLANES_MOAN4 },
    { .card = { CARD("yoshida6", "", "splitting", 6, 7, 7, XVT, 1, 1, 2.2690579963976594),
       .title = "Yoshida 6", .cite = "Yoshida90 table 1, solution A",
       .formula = "seven leapfrog steps of w₁ h … w₄ h … w₁ h" IMPLICIT_KICKS,
       .use = "The textbooks' order 6; blanes-moan6 is far more accurate at equal work." },
      .family = SPLITTING, .compensated = true, .composition = {7,
        C(K(0.7845136104775572638194976338663498757768), K(0.2355732133593581336847931829785346016865),
         K(-1.177679984178871006946415680964315734639), K(1.315186320683911218884249728238862514352))} },
    { .card = { CARD("kahan-li6", "", "splitting", 6, 9, 9, XVT, 1, 1, 2.532627388334297),
       .title = "Kahan–Li 6", .cite = "KahanLi97",
       .formula = "nine leapfrog steps, symmetric" IMPLICIT_KICKS,
       .use = "Order 6 for every force, velocity terms included." },
      .family = SPLITTING, .compensated = true, .composition = {9,
        C(K(0.39216144400731413927925056), K(0.33259913678935943859974864), K(-0.70624617255763935980996482),
         K(0.08221359629355080023149045), K(0.79854399093482996339895035))} },
    { .card = { CARD("blanes-moan6", "srkn11 blanes-moan-srkn11", "splitting", 6, 12, 11, XT, 1, 1, 3.1414310877528084),
       .title = "Blanes–Moan 6", .cite = "BM02",
       .formula = "twelve kicks and eleven drifts, symmetric, beginning with a kick; a Runge-Kutta-Nyström splitting",
       .use = "Order 6 for long, accurate runs of x'' = a(x, t)." },
      .family = SPLITTING, .nystrom = true, .compensated = true, BLANES_MOAN6 },
    { .card = { CARD("blanes-moan6-14", "srkn14 blanes-moan-srkn14", "splitting", 6, 14, 14, XT, 1, 1,
                     3.1409250826052366),
       .title = "Blanes–Moan 6, 14", .cite = "BM02",
       .formula = "fifteen drifts and fourteen kicks, symmetric, beginning with a drift; "
                  "a Runge-Kutta-Nyström splitting",
       .use = "Order 6 with the smallest error constant here." },
      .family = SPLITTING, .nystrom = true, .compensated = true, .splitting = {15,
        C(K(0.0), K(0.09171915262446165), K(0.183983170005006), K(-0.05653436583288827), K(0.004914688774712854),
          K(0.143761127168358), K(0.328567693746804), K(-0.19641146648645423), K(-0.19641146648645423),
          K(0.328567693746804), K(0.143761127168358), K(0.004914688774712854), K(-0.05653436583288827),
          K(0.183983170005006), K(0.09171915262446165)),
        C(K(0.0378593198406116), K(0.102635633102435), K(-0.0258678882665587), K(0.314241403071447),
          K(-0.130144459517415), K(0.106417700369543), K(-0.00879424312851058), K(0.2073050690568954),
          K(-0.00879424312851058), K(0.106417700369543), K(-0.130144459517415), K(0.314241403071447),
          K(-0.0258678882665587), K(0.102635633102435), K(0.0378593198406116))} },
    { .card = { CARD("yoshida8", "", "splitting", 8, 15, 15, XVT, 1, 1, 2.3565081394342591),
       .title = "Yoshida 8", .cite = "Yoshida90 table 2, solution D",
       .formula = "fifteen leapfrog steps, symmetric" IMPLICIT_KICKS,
       .use = "The textbooks' order 8; kahan-li8 is far more accurate at equal work." },
      /* The paper prints 15 digits, of which 13 satisfy the order conditions; Newton's method gives the others. */
      .family = SPLITTING, .compensated = true, .composition = {15,
        C(K(0.9148442462297915667487934898475096045181), K(0.2536933365662113541461460206899420760977),
         K(-1.444852236860605157694730657537390354956), K(-0.1582406353680501752040667767597542477554),
         K(1.938139137622525986579186487443641760954), K(-1.960610232975310807607633376399663640792),
         K(0.102799849391796440698115131601225862911), K(1.708453070787281584668379362228977878047))} },
    { .card = { CARD("kahan-li8", "", "splitting", 8, 17, 17, XVT, 1, 1, 3.0964386800007322),
       .title = "Kahan–Li 8", .cite = "KahanLi97",
       .formula = "seventeen leapfrog steps, symmetric" IMPLICIT_KICKS,
       .use = "Positions to round-off where the force is smooth; the most accurate row here at equal work, for\n"
              "every force, velocity terms included." },
      .family = SPLITTING, .compensated = true, KAHAN_LI8 },
    { .card = { CARD("boris", "", "splitting", 2, 1, 1, XVT, 0, 1, 2.0),
       .title = "Boris", .cite = "Boris70, Qin13, HL18",
       .formula = "x += h/2 v;   v' = v + h a(x, (v + v')/2, t + h/2);   x += h/2 v'\n"
                  "for a = E + v × B the kick is half a kick by E, the Boris rotation, half a kick: "
                  "the Cayley form of the rotation",
       .use = "Charged particles: keeps phase-space volume, though it is not symplectic in general, and energy where\n"
              "E = 0; stable beyond the gyration." },
      .family = SPLITTING, .gyroscopic = true, .splitting = {2, C(K(0.0), K(1.0)), C(K(0.5), K(0.5))} },

    /* Explicit Runge-Kutta. */
    { .card = { CARD("explicit-euler", "euler forward-euler rk1", "runge-kutta", 1, 1, 1, XVT, 0, 0, 0.0),
       .title = "explicit Euler", .cite = "Euler1768",
       .formula = "x₁ = x + h v;   v₁ = v + h a(x, v, t)",
       .use = "To see what goes wrong: the energy grows without bound." },
      .family = RUNGE_KUTTA, .tableau = {.stages = 1, .c = C(K(0.0)), .b = C(K(1.0))} },
    { .card = { CARD("midpoint", "rk2 explicit-midpoint modified-euler", "runge-kutta", 2, 2, 2, XVT, 0, 0, 0.0),
       .title = "midpoint (RK2)", .cite = "Runge1895",
       .formula = "half a step of Euler's method gives the slope for the whole step",
       .use = "Order 2 for any force, over short times." },
      .family = RUNGE_KUTTA, .tableau = {.stages = 2, .c = C(K(0.0), K(0.5)), .a = C(K(0.5)), .b = C(K(0.0), K(1.0))} },
    { .card = { CARD("heun", "improved-euler explicit-trapezoid", "runge-kutta", 2, 2, 2, XVT, 0, 0, 0.0),
       .title = "Heun", .cite = "Heun1900",
       .formula = "the mean of the slopes at the start and at Euler's end point",
       .use = "As midpoint." },
      .family = RUNGE_KUTTA, .tableau = {.stages = 2, .c = C(K(0.0), K(1.0)), .a = C(K(1.0)), .b = C(K(0.5), K(0.5))} },
    { .card = { CARD("ralston", "ralston2", "runge-kutta", 2, 2, 2, XVT, 0, 0, 0.0),
       .title = "Ralston", .cite = "Ralston62",
       .formula = "abscissae 0, 2/3;   weights 1/4, 3/4",
       .use = "Order 2 with the smallest bound of the local error." },
      .family = RUNGE_KUTTA, .tableau = {.stages = 2, .c = C(K(0.0), K(2.0) / K(3.0)), .a = C(K(2.0) / K(3.0)),
                  .b = C(K(0.25), K(0.75))} },
    { .card = { CARD("rk3", "kutta3", "runge-kutta", 3, 3, 3, XVT, 0, 0, 1.7320508075688773),
       .title = "RK3", .cite = "Kutta1901",
       .formula = "abscissae 0, 1/2, 1;   weights 1/6, 2/3, 1/6 (Simpson's rule)",
       .use = "Order 3 for any force." },
      .family = RUNGE_KUTTA, .tableau = {.stages = 3, .c = C(K(0.0), K(0.5), K(1.0)), .a = C(K(0.5),   K(-1.0), K(2.0)),
                  .b = C(K(1.0) / K(6.0), K(2.0) / K(3.0), K(1.0) / K(6.0))} },
    { .card = { CARD("rk4", "kutta4 runge-kutta", "runge-kutta", 4, 4, 4, XVT, 0, 0, 2.8284271247461901),
       .title = "RK4", .cite = "Kutta1901, HNW93 II.1 table 1.2",
       .formula = "abscissae 0, 1/2, 1/2, 1;   weights 1/6, 1/3, 1/3, 1/6",
       .use = "The all-purpose method for short and middle times; energy decays slowly." },
      .family = RUNGE_KUTTA, .tableau = {.stages = 4, .c = C(K(0.0), K(0.5), K(0.5), K(1.0)),
                  .a = C(K(0.5),   K(0.0), K(0.5),   K(0.0), K(0.0), K(1.0)),
                  .b = C(K(1.0) / K(6.0), K(1.0) / K(3.0), K(1.0) / K(3.0), K(1.0) / K(6.0))} },
    { .card = { CARD("rk4-38", "three-eighths rk38 kutta38", "runge-kutta", 4, 4, 4, XVT, 0, 0, 2.8284271247461901),
       .title = "RK4, 3/8", .cite = "Kutta1901, HNW93 II.1 table 1.2",
       .formula = "abscissae 0, 1/3, 2/3, 1;   weights 1/8, 3/8, 3/8, 1/8",
       .use = "As rk4, with other error terms; which is better depends on the problem." },
      .family = RUNGE_KUTTA, .tableau = {.stages = 4, .c = C(K(0.0), K(1.0) / K(3.0), K(2.0) / K(3.0), K(1.0)),
                  .a = C(K(1.0) / K(3.0),   K(-1.0) / K(3.0), K(1.0),   K(1.0), K(-1.0), K(1.0)),
                  .b = C(K(1.0) / K(8.0), K(3.0) / K(8.0), K(3.0) / K(8.0), K(1.0) / K(8.0))} },

    /* Embedded pairs of Runge-Kutta methods: they choose their steps by the tolerance. */
    { .card = { CARD("bs32", "bogacki-shampine ode23", "runge-kutta", 3, 3, 3, XVT, 0, 0, 1.7320508075688772),
       .title = "Bogacki–Shampine 3(2)", .cite = "BogackiShampine89",
       .formula = "three stages and a fourth at the end of the step, for an estimate of order 2",
       .use = "Low accuracy, 1e-3 or so, and rough forces.", .adaptive = 1 },
      PAIR(BS32, 3, 2, .ending = true, .dense = DENSE(0, 3, NULL, NULL, BS32_SERIES)) },
    { .card = { CARD_BETWEEN(4, "dopri5", "dormand-prince ode45 rk45", "runge-kutta", 5, 6, 6, XVT, 0, 0,
                              0.99718900863252991),
       .title = "Dormand–Prince 5(4)", .cite = "DormandPrince80, HNW93 II.5",
       .formula = "six stages and a seventh at the end of the step, for an estimate of order 4",
       .use = "The pair that most programs take, at 1e-3 to 1e-7, for any force.", .adaptive = 1 },
      PAIR(DOPRI5, 6, 4, .ending = true, .dense = DENSE(0, 4, NULL, NULL, DOPRI5_SERIES)) },
    { .card = { CARD_BETWEEN(4, "tsit5", "tsitouras5", "runge-kutta", 5, 6, 6, XVT, 0, 0,
                              0.47797886888275209),
       .title = "Tsitouras 5(4)", .cite = "Tsitouras11",
       .formula = "six stages and a seventh at the end of the step, for an estimate of order 4",
       .use = "As dopri5, with a smaller error at equal work on many problems.", .adaptive = 1 },
      PAIR(TSIT5, 6, 4, .ending = true, .dense = DENSE(0, 4, NULL, NULL, TSIT5_SERIES)) },
    { .card = { CARD("verner6", "vern6", "runge-kutta", 6, 8, 8, XVT, 0, 0, 2.5841995676074592),
       .title = "Verner 6(5)", .cite = "Verner10",
       .formula = "eight stages and a ninth at the end of the step, for an estimate of order 5",
       .use = "Between dopri5 and dop853.", .adaptive = 1 },
      PAIR(VERNER6, 8, 5, .ending = true, .dense = DENSE(3, 6, VERNER6_MORE_C, VERNER6_MORE_A, VERNER6_SERIES)) },
    { .card = { CARD_BETWEEN(6, "verner7", "vern7", "runge-kutta", 7, 10, 10, XVT, 0, 0, 0.0),
       .title = "Verner 7(6)", .cite = "Verner10",
       .formula = "ten stages",
       .use = "Between dopri5 and dop853.", .adaptive = 1 },
      PAIR(VERNER7, 10, 6, .dense = DENSE(5, 7, VERNER7_MORE_C, VERNER7_MORE_A, VERNER7_SERIES)) },
    { .card = { CARD_BETWEEN(7, "dop853", "dormand-prince8", "runge-kutta", 8, 12, 12, XVT, 0, 0,
                              5.9603598117027792),
       .title = "Dormand–Prince 8(5, 3)", .cite = "HNW93 II.5 and II.10",
       .formula = "twelve stages; the error is judged by two estimates, of order 5 and of order 3",
       .use = "High accuracy, 1e-7 to round-off, for any force.", .adaptive = 1 },
      PAIR(DOP853, 12, 7, .second = DOP853_SECOND, .dense = DENSE(3, 7, DOP853_MORE_C, DOP853_MORE_A, DOP853_SERIES)) },
    { .card = { CARD("verner8", "vern8", "runge-kutta", 8, 13, 13, XVT, 0, 0, 0.0),
       .title = "Verner 8(7)", .cite = "Verner10",
       .formula = "thirteen stages",
       .use = "As dop853, with an estimate of higher order.", .adaptive = 1 },
      PAIR(VERNER8, 13, 7, .dense = DENSE(7, 8, VERNER8_MORE_C, VERNER8_MORE_A, VERNER8_SERIES)) },
    { .card = { CARD("verner9", "vern9", "runge-kutta", 9, 16, 16, XVT, 0, 0, 2.7569651249245202),
       .title = "Verner 9(8)", .cite = "Verner10",
       .formula = "sixteen stages",
       .use = "The highest order of these pairs, for any force.", .adaptive = 1 },
      PAIR(VERNER9, 16, 8, .dense = DENSE(9, 9, VERNER9_MORE_C, VERNER9_MORE_A, VERNER9_SERIES)) },

    /* Nyström methods: x'' = a is integrated as it is, at about half the stages. */
    { .card = { CARD("dep4", "dprkn4 rkn43", "nystrom", 4, 4, 3, XT, 0, 0, 3.7678207258077578),
       .title = "Dormand–El-Mikkawy–Prince 4(3)", .cite = "DEP87a",
       .formula = "four stages, the last at the end of the step",
       .use = "Low accuracy, for forces that are free of v.", .adaptive = 1 },
      NYSTROM_PAIR(DEP4, 4, 3, .closing = true) },
    { .card = { CARD_BETWEEN(5, "dep6", "dprkn6 rkn64", "nystrom", 6, 6, 5, XT, 0, 0, 0.0),
       .title = "Dormand–El-Mikkawy–Prince 6(4)", .cite = "DEP87a",
       .formula = "six stages, the last at the end of the step",
       .use = "1e-3 to 1e-7, for forces that are free of v.", .adaptive = 1 },
      NYSTROM_PAIR(DEP6, 6, 4, .closing = true, .dense = DENSE(0, 5, NULL, NULL, DEP6_SERIES)) },
    { .card = { CARD("dep8", "dprkn8 rkn86", "nystrom", 8, 8, 8, XT, 0, 0, 3.1402541625390064),
       .title = "Dormand–El-Mikkawy–Prince 8(6)", .cite = "DEP87b",
       .formula = "eight stages and a ninth at the end of the step",
       .use = "1e-5 to 1e-9, for forces that are free of v.", .adaptive = 1 },
      NYSTROM_PAIR(DEP8, 8, 6, .ending = true) },
    { .card = { CARD("dep12", "dprkn12 rkn1210", "nystrom", 12, 17, 17, XT, 0, 0, 3.1415925817546406),
       .title = "Dormand–El-Mikkawy–Prince 12(10)", .cite = "DEP87b",
       .formula = "seventeen stages",
       .use = "The choice at 1e-7 and better for forces that are free of v.", .adaptive = 1 },
      NYSTROM_PAIR(DEP12, 17, 10) },
    { .card = { CARD("fine4", "rkng43", "nystrom", 4, 5, 5, XVT, 0, 0, 0.0),
       .title = "Fine 4(3)", .cite = "Fine87",
       .formula = "five stages, of positions and of velocities",
       .use = "A Nyström method for forces that depend on the velocity.", .adaptive = 1 },
      NYSTROM_PAIR(FINE4, 5, 3, .a = FINE4_A) },
    { .card = { CARD("fine5", "rkng54", "nystrom", 5, 6, 6, XVT, 0, 0, 0.0),
       .title = "Fine 5(4)", .cite = "Fine87",
       .formula = "six stages and a seventh at the end of the step",
       .use = "A Nyström method for forces that depend on the velocity.", .adaptive = 1 },
      NYSTROM_PAIR(FINE5, 6, 4, .a = FINE5_A, .ending = true) },
    /* Symmetric splittings with steps that can be taken backward: step/density.h. */
    { .card = { CARD("verlet-reversible", "adaptive-verlet", "splitting", 2, 2, 3, XT, 0, 1, 2.0),
       .title = "Verlet, reversible steps", .cite = "HS05, Swope82",
       .formula = "velocity-verlet with h = ε T, T the motion's time scale, about √(r³/k) on an orbit;\n"
                  "T₊ = T₋ (1 + z)/(1 − z) from step to step, z = (h/2) d(log T)/dt",
       .use = "Close passages over long times, at low accuracy: the energy error stays what it is after few\n"
              "orbits.", .adaptive = 1 },
      .family = SPLITTING, .adaptive = true, .density = true, VELOCITY_VERLET },
    { .card = { CARD("blanes-moan4-reversible", "", "splitting", 4, 7, 8, XT, 0, 1, 3.1634650665581867),
       .title = "Blanes–Moan 4, reversible steps", .cite = "HS05, BM02",
       .formula = "blanes-moan4 with h = ε T, T the motion's time scale as in verlet-reversible",
       .use = "As verlet-reversible, at 1e-4 to 1e-7.", .adaptive = 1 },
      .family = SPLITTING, .adaptive = true, .density = true, BLANES_MOAN4 },
    { .card = { CARD("blanes-moan6-reversible", "", "splitting", 6, 12, 14, XT, 0, 1, 3.1414310877528084),
       .title = "Blanes–Moan 6, reversible steps", .cite = "HS05, BM02",
       .formula = "blanes-moan6 with h = ε T, T the motion's time scale as in verlet-reversible",
       .use = "As verlet-reversible, at 1e-6 and better.", .adaptive = 1 },
      .family = SPLITTING, .adaptive = true, .density = true, .nystrom = true, .compensated = true, BLANES_MOAN6 },
    { .card = { CARD("kahan-li8-reversible", "", "splitting", 8, 17, 20, XVT, 0, 1, 3.0964386800007322),
       .title = "Kahan–Li 8, reversible steps", .cite = "HS05, KahanLi97",
       .formula = "kahan-li8 with h = ε T, T the motion's time scale as in verlet-reversible" IMPLICIT_KICKS,
       .use = "As verlet-reversible, at 1e-8 and better, and for forces that depend on the velocity.", .adaptive = 1 },
      .family = SPLITTING, .adaptive = true, .density = true, .compensated = true, KAHAN_LI8 },
    { .card = { CARD("gauss8-reversible", "", "implicit", 8, 4, 0, XVT, 0, 1, INFINITY),
       .title = "Gauss 8, reversible steps", .cite = "HS05, Butcher64",
       .formula = "gauss8 with h = ε T, T the motion's time scale as in verlet-reversible",
       .use = "As verlet-reversible, at 1e-8 and better, for every force.", .adaptive = 1 },
      .family = IMPLICIT, .adaptive = true, .density = true, .compensated = true, .tableau = {.stages = 4} },
    { .card = { CARD_BETWEEN(6, "gauss12-reversible", "", "implicit", 12, 6, 0, XVT, 0, 1, INFINITY),
       .title = "Gauss 12, reversible steps", .cite = "HS05, Butcher64",
       .formula = "gauss12 with h = ε T, T the motion's time scale as in verlet-reversible",
       .use = "As verlet-reversible, close to round-off, for every force.", .adaptive = 1 },
      .family = IMPLICIT, .adaptive = true, .density = true, .compensated = true, .tableau = {.stages = 6} },

    /* Implicit: Newmark, and collocation at the Gauss nodes, whose coefficients step/collocation.h makes. */
    NEWMARK(2, 1,
            "Structural dynamics. newmark(β, γ), by default (1/4, 1/2), which is stable at every step and keeps the\n"
            "energy of linear systems; (0, 1/2) is velocity-verlet with velocity terms; γ > 1/2 damps and drops to\n"
            "order 1."),
    { .card = { CARD("implicit-midpoint", "gauss2", "implicit", 2, 1, 0, XVT, 1, 1, INFINITY),
       .title = "implicit midpoint", .cite = "HLW06 II.1.3",
       .formula = "the slope is taken in the middle of the step, at the mean of its two ends",
       .use = "Stable at every step; keeps quadratic invariants, velocity terms included." },
      .family = IMPLICIT, .tableau = {.stages = 1} },
    { .card = { CARD("gauss4", "gauss-legendre4", "implicit", 4, 2, 0, XVT, 1, 1, INFINITY),
       .title = "Gauss 4", .cite = "Butcher64, HLW06 II.1.3",
       .formula = "collocation at the two Gauss nodes 1/2 ∓ √3/6",
       .use = "Order 4, reversible for every force and symplectic where it is a gradient; stable at every step." },
      .family = IMPLICIT, .tableau = {.stages = 2} },
    { .card = { CARD("gauss6", "gauss-legendre6", "implicit", 6, 3, 0, XVT, 1, 1, INFINITY),
       .title = "Gauss 6", .cite = "Butcher64, HLW06 II.1.3",
       .formula = "collocation at the three Gauss nodes 1/2, 1/2 ∓ √15/10",
       .use = "Order 6 for every force; the reference of choice where no exact motion is known." },
      .family = IMPLICIT, .compensated = true, .tableau = {.stages = 3} },
    { .card = { CARD("gauss8", "gauss-legendre8", "implicit", 8, 4, 0, XVT, 1, 1, INFINITY),
       .title = "Gauss 8", .cite = "Butcher64, HLW06 II.1.3",
       .formula = "collocation at the four Gauss nodes",
       .use = "Order 8 for every force." },
      .family = IMPLICIT, .compensated = true, .tableau = {.stages = 4} },
    { .card = { CARD_BETWEEN(5, "gauss10", "gauss-legendre10", "implicit", 10, 5, 0, XVT, 1, 1, INFINITY),
       .title = "Gauss 10", .cite = "Butcher64, HLW06 II.1.3",
       .formula = "collocation at the five Gauss nodes",
       .use = "Order 10 for every force." },
      .family = IMPLICIT, .compensated = true, .tableau = {.stages = 5} },
    { .card = { CARD_BETWEEN(6, "gauss12", "gauss-legendre12", "implicit", 12, 6, 0, XVT, 1, 1, INFINITY),
       .title = "Gauss 12", .cite = "Butcher64, HLW06 II.1.3",
       .formula = "collocation at the six Gauss nodes",
       .use = "Order 12 for every force; symplectic at high accuracy." },
      .family = IMPLICIT, .compensated = true, .tableau = {.stages = 6} },
    { .card = { CARD_BETWEEN(7, "gauss14", "gauss-legendre14", "implicit", 14, 7, 0, XVT, 1, 1, INFINITY),
       .title = "Gauss 14", .cite = "Butcher64, HLW06 II.1.3",
       .formula = "collocation at the seven Gauss nodes",
       .use = "Order 14 for every force." },
      .family = IMPLICIT, .compensated = true, .tableau = {.stages = 7} },
    { .card = { CARD_BETWEEN(8, "gauss16", "gauss-legendre16", "implicit", 16, 8, 0, XVT, 1, 1, INFINITY),
       .title = "Gauss 16", .cite = "Butcher64, HLW06 II.1.3",
       .formula = "collocation at the eight Gauss nodes",
       .use = "Order 16 for every force: energy to round-off over long runs at large steps." },
      .family = IMPLICIT, .compensated = true, .tableau = {.stages = 8} },

    /* Collocation whose first stage is the state. */
    { .card = { CARD_BETWEEN(8, "radau15", "ias15 gauss-radau15", "radau", 15, 8, 0, XVT, 0, 0, 0.0),
       .title = "Gauss–Radau 15", .cite = "Everhart85, RS15",
       .formula = "the polynomial of degree 7 through the accelerations at the eight left Radau nodes,\n"
                  "integrated once for v and twice for x",
       .use = "1e-6 to round-off for any force; on an orbit half of the evaluations that dop853 needs for the\n"
              "same error.", .adaptive = 1 },
      .family = RADAU, .adaptive = true, .compensated = true, .tableau = {.stages = 8} },
    { .card = { CARD_BETWEEN(8, "radau15-fixed", "", "radau", 15, 8, 0, XVT, 0, 0, 0.0),
       .title = "Gauss–Radau 15, fixed step", .cite = "Everhart85, RS15",
       .formula = "as radau15, by steps of one size",
       .use = "Order 15 for any force: positions to round-off, and an energy error that grows like the square root\n"
              "of time." },
      .family = RADAU, .compensated = true, .tableau = {.stages = 8} },

    /* Taylor series of the equations. Those of the velocities end one power before those of the positions. */
    { .card = { CARD("taylor", "taylor-series", "taylor", 23, 23, 23, XVT, 0, 0, 1.707179728091783),
       .title = "Taylor series", .cite = "JZ05",
       .formula = "x₁ = x + h v + h²/2 a + h³/6 a′ + … + h²⁴/24! a⁽²²⁾, as long as its last coefficients allow;\n"
                  "at larger tolerances of lower order, down to 5",
       .use = "The most digits for the least time, where the force is smooth. It needs the equations as\n"
              "formulas, so it does not take a callback.", .adaptive = 1, .any_order = 1, .series = 1 },
      .family = TAYLOR, .compensated = true, .adaptive = true, .sizes = true, .expands = true },

    /* Extrapolation: step/extrapolation.h. */
    { .card = { CARD("gragg-stormer", "odex2 stormer-extrapolation", "extrapolation", 12, 22, 22, XT, 0, 0,
                     3.1411691066486376),
       .title = "Gragg–Störmer", .cite = "HNW93 II.14",
       .formula = "Störmer's rule in 1, 2, 3, … parts of a step, extrapolated in the square of their length to\n"
                  "order 4 to 18, as error and work want it",
       .use = "1e-3 to round-off for forces that are free of v, by steps as long as the motion lets them be; dep12\n"
              "needs fewer evaluations for the same error, gragg-stormer fewer steps.", .adaptive = 1, .any_order = 1 },
      .family = STORMER, .adaptive = true, .orders = true, .compensated = true, .lines = 6 },
    { .card = { CARD("gragg", "gbs bulirsch-stoer odex", "extrapolation", 12, 37, 37, XVT, 0, 0, 3.3793773141571255),
       .title = "Gragg–Bulirsch–Stoer", .cite = "HNW93 II.9",
       .formula = "the midpoint rule in 2, 4, 6, … parts of a step, extrapolated in the square of their length to\n"
                  "order 4 to 18, as error and work want it",
       .use = "As gragg-stormer, for any force.", .adaptive = 1, .any_order = 1 },
      .family = GRAGG, .adaptive = true, .orders = true, .compensated = true, .lines = 6 },

    { .card = { CARD("exact", "closed-form", "exact", 0, 0, 0, XVT, 1, 1, INFINITY),
       .title = "exact", .cite = "",
       .formula = "the model's own exact line; or x = x₀ + v₀ τ + a τ²/2 where the acceleration is constant",
       .use = "The exact motion, where it is known: no error but round-off." },
      .family = EXACT },
};
/* clang-format on */
const size_t methods_count = sizeof methods_table / sizeof *methods_table;

const row methods_newmark_damped =
    NEWMARK(1, 0, "Newmark's method with γ other than 1/2: it damps high frequencies (γ > 1/2) and is of order 1.");
