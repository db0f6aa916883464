#pragma once

#include <memory>

#include "validation/subject/subject.h"

namespace ursula {

/// The users' kernels, with torques and accelerations only: a fast formulation independent of the NOC.
Subject fastSubject(const Manipulator& manipulator, const std::shared_ptr<const Load>& load);

}  // namespace ursula
