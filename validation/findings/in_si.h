#pragma once

#include "validation/subject/presentation.h"
#include "validation/verdict/result.h"

namespace ursula {

/// Series and curves from a presentation's units and origin to SI and B, by their columns' names.
void seriesInSi(const Presentation& from, ValidationResult& result);

}  // namespace ursula
