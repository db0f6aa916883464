#pragma once

// Noc in the order of the paper, for the sources that instantiate it.

#include "nocsolver/noc/section_2.h"              // kinematics and Jacobians, (1)–(26)
#include "nocsolver/noc/section_3_bodies.h"       // the bodies' twists, (39)–(43)
#include "nocsolver/noc/section_3_complement.h"   // T and its rate, (32), (47), (48)
#include "nocsolver/noc/section_3_constraints.h"  // D of (33), and the reactions
#include "nocsolver/noc/section_3_dynamics.h"     // (28)–(38), (45), (46)
