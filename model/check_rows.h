#pragma once

#include "model/check_catalogue.h"

namespace ursula {

/// The three parts of the catalogue, in this order.
std::vector<CheckRow> checksOfInput();
std::vector<CheckRow> checksOfTorques();
std::vector<CheckRow> checksOfReplay();

}  // namespace ursula
