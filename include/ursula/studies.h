#pragma once

/// \file
/// Functions beside validation: simulate(), simulateMechanism(), warnings(), partBlindSpots() and picture() of a
/// scenario, mapBlocks(), compare().

#include "include/ursula/abi.h"
#include "parts/compare/compare.h"
#include "parts/map/pose_map.h"
#include "parts/simulate/simulate.h"
#include "parts/simulate/simulate_mechanism.h"
#include "report/page/scenario_picture.h"
#include "validation/blind_spots.h"
#include "validation/check_scenario/check_scenario.h"
#include "validation/subject/motion_check.h"
