#pragma once

/// \file
/// Measured efforts against the model: readMeasuredLog(), identify() and what they return; excite().

#include "base/csv.h"
#include "include/ursula/abi.h"
#include "parts/identify/excite.h"
#include "parts/identify/identify.h"
