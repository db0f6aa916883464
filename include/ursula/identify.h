#pragma once

/// \file
/// Measured efforts against the model: readMeasuredLog(), identify() and what they return; excite().

#include "base/csv.h"
#include "include/ursula/abi.h"
#include "studies/identify/excite.h"
#include "studies/identify/identify.h"
