#include "model/check_rows.h"

namespace ursula {

std::vector<CheckRow> checksOfReplay() {
  using N = CheckNeeds;
  using G = CheckGroup;
  return {
      {"replay.position", "m", N::nothing, G::replay, StandsOn::engine, "Position along the motion",
       "Simbody's loop, driven by the efforts alone, stays on the commanded path.",
       "Simbody's closed loop, driven by the efforts alone, keeps P on the commanded path.",
       "what the amplification hides", LimitFrom::derived,
       "Rounding and integration error, measured and carried along the motion by its own growth of deviations.",
       "The dominant error is named: for torques see torque.pointwise, for integration tighten [simulation] "
       "tolerance."},
      {"replay.orientation", "rad", N::nothing, G::replay, StandsOn::engine, "Orientation along the motion",
       "Likewise its orientation.",
       "Simbody's closed loop, driven by the efforts alone, keeps the platform's orientation.",
       "what the amplification hides", LimitFrom::derived, "As for replay.position, of the angle.",
       "See replay.position; where that one passes, suspect the platform's inertia."},
      {"closure.position", "m", N::nothing, G::replay, StandsOn::engine, "Loops stay closed",
       "The legs keep hold of the platform.",
       "The loops of the replay stay closed: legs and platform keep their common points.", "", LimitFrom::derived,
       "Rounding of the accelerations at which gaps open over the window, and three times a coarser replay's gaps.",
       "The replay is not of this machine: look at integrator and tolerance before you doubt the torques."},
      {"closure.velocity", "m/s", N::nothing, G::replay, StandsOn::engine, "Loops stay closed, rates",
       "Likewise their velocities.", "The loops of the replay stay closed in velocity too.", "", LimitFrom::derived,
       "Rounding of the accelerations at which gaps open, once integrated, and three times a coarser replay's.",
       "As for closure.position: the integration, not the solver, is in question."},
      {"energy.balance", "J", N::nothing, G::replay, StandsOn::engine, "Energy",
       "Energy gained is the motors' work, less what friction takes.",
       "Work of motors, friction and load is the change of kinetic and potential energy.", "errors that do no work",
       LimitFrom::derived,
       "A rounding a step, the gaps' limit times the forces there, and three times a coarser replay's error.",
       "A power is missing or has the wrong sign: friction or a load that the engine has and the account has not."},
      {"integration.ladder", "m", N::any_instant, G::numerics, StandsOn::engine, "Finer steps, same motion",
       "The replay settles as its tolerance is tightened.",
       "The replay settles as its tolerance is tightened, step by step.", "", LimitFrom::measured,
       "A quarter of the error at a hundredfold tolerance, or what rounding may make of it.",
       "The motion or the torques are too rough for the integrator: smooth them, or give more instants."},
      {"integration.second", "m", N::any_instant, G::numerics, StandsOn::engine, "A second integrator",
       "Another integrator finds the same motion.", "Simbody's own integrator ends where the program's does.", "",
       LimitFrom::measured, "Ten times what ten times its accuracy changes, and the limit of replay.position.",
       "One of two integrators is wrong: run again with [simulation] integrator set to the other."},
      {"integration.order", "", N::any_instant, G::numerics, StandsOn::engine, "Order of the integrator",
       "The error falls at the order that the integrator has.",
       "Halving fixed steps makes the error fall at the order of 8 that the integrator has.", "", LimitFrom::exact,
       "1.25 below 8, where the observed order has settled; else it is left open.",
       "The integrator or its coefficients are broken: report it; other checks of the replay are then worth little."},
      {"feedback.torque", "N m", N::any_instant, G::replay, StandsOn::engine, "Held on the path",
       "A controller that holds Simbody on the path has nothing to add.",
       "A weak controller that holds Simbody on the path has nothing to add to the efforts, over the whole motion.",
       "errors much shorter than 1/ω_f", LimitFrom::derived,
       "4/3 of twice the efforts' largest rounding, the accelerations' as efforts, and half as much for the steps.",
       "The efforts lack what it had to add, there and then: compare with torque.pointwise and torque.between."},
  };
}

}  // namespace ursula
