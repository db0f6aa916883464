#include "validation/report/check_help.h"

namespace ursula::report {
namespace {

struct Entry {
  const char* name;
  LimitFrom from;
  const char *proves, *limit, *on_failure;
};

// What stands in docs/validation.md at length.
const Entry entries[] = {
    {"motion.pose", LimitFrom::derived,
     "The pose that every road is commanded is the one in 50 digits: position, and a quaternion of length one.",
     "25 roundings of everything that is added up on the way to p and Q.",
     "The trajectory loses digits: look for positions far from the origin of B or points of time very close together."},
    {"motion.twist", LimitFrom::derived,
     "The commanded v and ω are the derivatives of p and Q, by differences of 50-digit poses.",
     "25 roundings of everything that is added up for v and ω.",
     "A trajectory of your own gives velocities that are not those of its poses: check frame and sign of ω."},
    {"motion.twist_rate", LimitFrom::derived,
     "The commanded a and α are the second derivatives of p and Q, by differences of 50-digit poses.",
     "25 roundings of everything that is added up for a and α.",
     "A trajectory of your own gives accelerations that are not those of its poses: check the terms with ω × ω."},
    {"motion.load", LimitFrom::derived,
     "The load meets every row of its table, is the quintic between them, and stays within the rows' range.",
     "0 at the rows and beyond the table; between them 25 roundings of the quintic's terms, found in 50 digits.",
     "Report it: the load's table is read or interpolated wrongly by this program."},
    {"motion.reading", LimitFrom::exact,
     "Every number of machine, motion and load is the one in the file, as other code reads it a second time.",
     "No number may differ; poses in 50 digits agree to the last.",
     "The scenario was changed after it was read, or the reader misunderstood it: the line names the first number."},
    {"kinematics.joint_angles", LimitFrom::measured,
     "The solver's φ, ψ, θ, (1) to (19), and d are those that vector geometry finds for Simbody's loop.",
     "The spread of both roads over the same machine turned, relabelled and rescaled, times ten.",
     "Check the zero and the sign of each angle, and which bend of the knee the solver takes."},
    {"kinematics.joint_rates", LimitFrom::measured,
     "The solver's joint rates are those of Simbody's own constraint Jacobian.",
     "As for the angles, grown by the condition number κ(B) of the pose.",
     "Where the angles pass, look at the leg's rate equations; where one leg alone is off, at its parameters."},
    {"kinematics.joint_accelerations", LimitFrom::measured,
     "The solver's joint accelerations are those of Simbody's constraints, once more differentiated.",
     "As for the rates, grown by the conditioning of the legs and of the pose.",
     "Where the rates pass, look at the terms that are quadratic in them."},
    {"kinematics.positions", LimitFrom::measured,
     "Mass centres and orientations of all bodies are those of Simbody, (16) and (17).",
     "The spread of both roads' positions over other presentations, over the size of the machine.",
     "The line names body and instant: check where its mass centre lies along the link, and its frame."},
    {"kinematics.twists", LimitFrom::measured,
     "Linear and angular velocities of all bodies are those of Simbody, (39) to (41).",
     "The spread of both roads' velocities over other presentations, over size and rates.",
     "Where positions pass, the body's twist is formed wrongly: about which point, in which frame?"},
    {"kinematics.accelerations", LimitFrom::measured,
     "Linear and angular accelerations of all bodies are those of Simbody, (42) and (43).",
     "The spread of both roads' accelerations over other presentations, over size and accelerations.",
     "Where velocities pass, a centripetal or Coriolis term of the named body is missing."},
    {"kinematics.jacobian", LimitFrom::measured,
     "T of (24) and (25) makes the commanded twist of Simbody's joint rates.",
     "The rates' noise, once more grown by κ(B).",
     "Check the reference point of T and the order [ω; v]; one wrong column is one leg."},
    {"kinematics.jacobian_rate", LimitFrom::measured,
     "T and its rate (26) make the commanded acceleration of Simbody's joint accelerations.",
     "The joint accelerations' noise, once more grown by κ(B).",
     "See whether jacobian_difference fails too: then Ṫ is not the derivative of T."},
    {"kinematics.jacobian_difference", LimitFrom::measured,
     "Ṫ is the derivative of T itself, with no other road in it.",
     "T's rounding over the step of a five-point difference, and what doubling the step changes.",
     "Ṫ has an error of its own; T may still be right."},
    {"torque.pointwise", LimitFrom::measured,
     "The efforts on trial are those of Simbody's own inverse dynamics, instant by instant.",
     "The spread of both roads' efforts over other presentations, times ten, shaped by the pose's conditioning.",
     "Read the likely cause and the table of legs; then compare masses, inertias, gravity and signs with the "
     "scenario."},
    {"acceleration.pointwise", LimitFrom::measured,
     "Simbody, given the efforts on trial, accelerates the platform as commanded.",
     "The efforts' limit through the inverse mass matrix, and the noise of the forces that close the loops.",
     "Where torque.pointwise fails this follows; alone, it says that Simbody's forward dynamics are in trouble there."},
    {"torque.against_noc", LimitFrom::measured,
     "The file's efforts are those of this program's solver (37), at the file's own instants.",
     "As for torque.pointwise, and half a unit of the last digit that the file prints.",
     "Read the likely cause; see that the file's instants are seconds of this motion and its legs in this order."},
    {"torque.twin", LimitFrom::measured,
     "A second Simbody model with the loops cut elsewhere, a tree through leg 1, needs the same efforts.",
     "A level of the twin's own, measured over other presentations.",
     "Where torque.pointwise passes, the fault is in this program's use of Simbody: report it with the scenario."},
    {"torque.maximal", LimitFrom::measured,
     "Thirteen free bodies, Newton and Euler and 72 constraints with multipliers need the same efforts.",
     "A level of the maximal coordinates' own, measured over other presentations.",
     "Where every other road agrees, the fault is in that road: the finding 'odd one out' names it."},
    {"torque.mujoco", LimitFrom::measured,
     "MuJoCo's inverse dynamics of the open trees, closed by multipliers, give the same efforts.",
     "A level of MuJoCo's own, measured over other presentations.",
     "Where the others agree, compare MuJoCo's version; where none does, the solver is wrong."},
    {"invariance.rotation", LimitFrom::measured, "The world turned, gravity included, asks for the same efforts.",
     "Twice the solver's own rounding, for the turned world and the one as it is.",
     "Gravity or an axis is taken from a fixed frame instead of the scenario."},
    {"invariance.labels", LimitFrom::measured, "Legs with other numbers carry their efforts along.",
     "Twice the solver's own rounding, for the two orders of the legs.",
     "A number of one leg is used for another, or an index is off by one."},
    {"invariance.mass", LimitFrom::measured, "Twice all masses, inertias and frictions need twice the efforts.",
     "Twice the solver's own rounding, for the doubled machine.",
     "A mass, inertia or friction stands in the solver as a constant, or one is left out."},
    {"invariance.time_reversal", LimitFrom::measured,
     "The mean of the efforts there and back is what the motion needs without friction.",
     "Twice the solver's own rounding, for the way there and the way back.",
     "A term is odd in the velocities: a sign in the Coriolis terms, or friction where there is none."},
    {"reactions.pointwise", LimitFrom::measured, "Forces and moments at 18 joints are those of Simbody.",
     "The efforts' noise over the machine's length times κ(B), and the accelerations' times the largest mass.",
     "Where the efforts pass, look at the point and the frame that the named joint's reaction is given in."},
    {"torque.between", LimitFrom::measured,
     "At 10,000 instants and more between the samples the efforts are those of the formulas that hold.",
     "That of torque.pointwise, at each of these instants.",
     "The solver does something between the samples: a branch, a table, a pulse. The line gives the instant."},
    {"direct.pointwise", LimitFrom::measured,
     "The solver's direct dynamics (36) give the commanded accelerations, and with each motor's effort changed.",
     "The shape of acceleration.pointwise at a level of its own.",
     "Where torque.pointwise passes, check the mass matrix and the sign of friction in (36)."},
    {"direct.growth", LimitFrom::measured,
     "Deviations from the path grow as the linearised direct dynamics say: Simbody is put off the path and watched.",
     "What is even in the deviation, what finer intervals and tolerances change, and the accelerations' rounding.",
     "The solver's direct dynamics are wrong beside the path, though they may be right on it."},
    {"replay.position", LimitFrom::derived,
     "Simbody's closed loop, driven by the efforts alone, keeps P on the commanded path.",
     "Rounding and integration error, measured and carried along the motion by its own growth of deviations.",
     "The dominant error is named: for torques see torque.pointwise, for integration tighten [simulation] tolerance."},
    {"replay.orientation", LimitFrom::derived,
     "Simbody's closed loop, driven by the efforts alone, keeps the platform's orientation.",
     "As for replay.position, of the angle.",
     "See replay.position; where that one passes, suspect the platform's inertia."},
    {"closure.position", LimitFrom::derived,
     "The loops of the replay stay closed: legs and platform keep their common points.",
     "Rounding of the accelerations at which gaps open over the window, and three times a coarser replay's gaps.",
     "The replay is not of this machine: look at integrator and tolerance before you doubt the torques."},
    {"closure.velocity", LimitFrom::derived, "The loops of the replay stay closed in velocity too.",
     "Rounding of the accelerations at which gaps open, once integrated, and three times a coarser replay's.",
     "As for closure.position: the integration, not the solver, is in question."},
    {"energy.balance", LimitFrom::derived,
     "Work of motors, friction and load is the change of kinetic and potential energy.",
     "A rounding a step, the gaps' limit times the forces there, and three times a coarser replay's error.",
     "A power is missing or has the wrong sign: friction or a load that the engine has and the account has not."},
    {"integration.ladder", LimitFrom::measured, "The replay settles as its tolerance is tightened, step by step.",
     "A quarter of the error at a hundredfold tolerance, or what rounding may make of it.",
     "The motion or the torques are too rough for the integrator: smooth them, or give more instants."},
    {"integration.second", LimitFrom::measured, "Simbody's own integrator ends where the program's does.",
     "Ten times what ten times its accuracy changes, and the limit of replay.position.",
     "One of two integrators is wrong: run again with [simulation] integrator set to the other."},
    {"integration.order", LimitFrom::exact,
     "Halving fixed steps makes the error fall at the order of 8 that the integrator has.",
     "1.25 below 8, where the observed order has settled; else it is left open.",
     "The integrator or its coefficients are broken: report it; other checks of the replay are then worth little."},
    {"feedback.torque", LimitFrom::derived,
     "A weak controller that holds Simbody on the path has nothing to add to the efforts, over the whole motion.",
     "4/3 of twice the efforts' largest rounding, the accelerations' as efforts, and half as much for the steps.",
     "The efforts lack what it had to add, there and then: compare with torque.pointwise and torque.between."},
};

}  // namespace

const char* name(LimitFrom from) {
  switch (from) {
    case LimitFrom::exact:
      return "exact";
    case LimitFrom::derived:
      return "derived";
    case LimitFrom::measured:
      break;
  }
  return "measured";
}

CheckHelp checkHelp(const std::string& check) {
  for (const Entry& entry : entries)
    if (check == entry.name) return {entry.proves, entry.from, entry.limit, entry.on_failure};
  return {};
}

}  // namespace ursula::report
