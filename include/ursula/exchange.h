#pragma once

/// \file
/// Import of foreign models: importModel() reads a file in SDF, MJCF or URDF.

#include "exchange/import.h"
#include "include/ursula/abi.h"
