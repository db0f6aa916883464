#pragma once

/// \file
/// Import of foreign models: importModel() reads a file in SDF, MJCF or URDF.

#include "exchange/import.h"
#include "exchange/import_error.h"
#include "include/ursula/abi.h"
