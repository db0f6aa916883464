#pragma once

/// \file
/// Functions beside validation: simulate(), warnings() and picture() of a scenario, mapBlocks(), compare().

#include "include/ursula/abi.h"
#include "studies/check_scenario/check_scenario.h"
#include "studies/compare/compare.h"
#include "studies/map/pose_map.h"
#include "studies/simulate/simulate.h"
#include "validation/subject/motion_check.h"
