#pragma once

/// \file
/// Includes the whole library.

#include "include/ursula/abi.h"
#include "include/ursula/exchange.h"
#include "include/ursula/identify.h"
#include "include/ursula/mechanism.h"
#include "include/ursula/report.h"
#include "include/ursula/scenario.h"
#include "include/ursula/solver.h"
#include "include/ursula/studies.h"
#include "include/ursula/validate.h"
