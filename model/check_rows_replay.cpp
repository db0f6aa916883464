#include "model/check_catalogue.h"

namespace ursula {

std::vector<CheckRow> checksOfReplay() {
  using N = CheckNeeds;
  using G = CheckGroup;
  return {
      {"replay.position", "m", N::nothing, G::replay, StandsOn::engine, "Position along the motion",
       "Simbody's loop, driven by the efforts alone, stays on the commanded path.",
       "Simbody's closed loop, driven by the efforts alone, keeps P on the commanded path.",
       "what the amplification hides", LimitFrom::derived,
       "The measured rounding and integration errors, grown along the motion as its deviations grow.",
       "The result names the dominant error: for torques see torque.pointwise, for integration tighten [simulation] "
       "tolerance."},
      {"replay.orientation", "rad", N::nothing, G::replay, StandsOn::engine, "Orientation along the motion",
       "Simbody's loop, driven by the efforts alone, keeps the commanded orientation.",
       "Simbody's closed loop, driven by the efforts alone, keeps the platform's orientation.",
       "what the amplification hides", LimitFrom::derived, "The same as for replay.position, for the angle.",
       "See replay.position; if that check passes, the platform's inertia may be wrong."},
      {"closure.position", "m", N::nothing, G::replay, StandsOn::engine, "Loops stay closed",
       "The legs stay attached to the platform.",
       "The loops of the replay stay closed: legs and platform keep their common points together.", "",
       LimitFrom::derived,
       "The rounding of the accelerations that open gaps over the window, plus three times a coarser replay's gaps.",
       "The replayed machine has come apart: check integrator and tolerance before you doubt the torques."},
      {"closure.velocity", "m/s", N::nothing, G::replay, StandsOn::engine, "Loops stay closed, rates",
       "The legs and the platform keep the same velocities where they meet.",
       "The loops of the replay stay closed in velocity too.", "", LimitFrom::derived,
       "The rounding of the accelerations that open gaps, integrated once, plus three times a coarser replay's.",
       "The same as for closure.position: suspect the integration, not the solver."},
      {"energy.balance", "J", N::nothing, G::replay, StandsOn::engine, "Energy",
       "The energy gained equals the work of the motors less the loss by friction.",
       "The work of motors, friction and load equals the change of kinetic and potential energy.",
       "errors that do no work", LimitFrom::derived,
       "One rounding per step, the limit of the gaps times the forces there, plus three times a coarser replay's "
       "error.",
       "A power is missing or has the wrong sign: the balance lacks friction or a load that the engine has."},
      {"integration.ladder", "m", N::any_instant, G::numerics, StandsOn::engine, "Finer steps, same motion",
       "The replay converges as its tolerance is tightened.",
       "The replay converges as its tolerance is tightened step by step.", "", LimitFrom::measured,
       "A quarter of the error at a hundredfold tolerance, or the error that rounding may cause.",
       "The motion or the torques are too rough for the integrator: smooth them, or give more instants."},
      {"integration.second", "m", N::any_instant, G::numerics, StandsOn::engine, "A second integrator",
       "Another integrator computes the same motion.", "Simbody's own integrator ends where the program's does.", "",
       LimitFrom::measured,
       "Ten times the change when its accuracy is raised tenfold, plus the limit of replay.position.",
       "One of the two integrators is wrong: run again with [simulation] integrator set to the other."},
      {"integration.order", "", N::any_instant, G::numerics, StandsOn::engine, "Order of the integrator",
       "The error falls at the order of the integrator.",
       "When fixed steps are halved, the error falls at the integrator's order of 8.", "", LimitFrom::exact,
       "1.25 below 8 if the observed order has settled; else the check is inconclusive.",
       "The integrator or its coefficients are wrong: report it. The other checks of the replay then prove little."},
      {"feedback.torque", "N m", N::any_instant, G::replay, StandsOn::engine, "Held on the path",
       "A controller that holds Simbody on the path adds nothing.",
       "A weak controller that holds Simbody on the path adds nothing to the efforts over the whole motion.",
       "errors much shorter than 1/ω_f", LimitFrom::derived,
       "4/3 of: twice the largest rounding of the efforts plus that of the accelerations as efforts; half as much for "
       "the steps.",
       "The efforts lack what the controller added at that instant: compare with torque.pointwise and torque.between."},
  };
}

}  // namespace ursula
