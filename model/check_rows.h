#pragma once

#include "model/check_catalogue.h"

namespace ursula {

/// The catalogue in three files, in this order.
std::vector<CheckRow> checksOfInput();
std::vector<CheckRow> checksOfTorques();
std::vector<CheckRow> checksOfReplay();

}  // namespace ursula
