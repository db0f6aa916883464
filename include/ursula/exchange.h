#pragma once

/// \file
/// Import of foreign models: importModel() reads a file in SDF, MJCF or URDF.

#include "include/ursula/abi.h"
#include "parts/exchange/import.h"
