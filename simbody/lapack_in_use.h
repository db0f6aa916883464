#pragma once

#include <string>

namespace ursula {

/// Returns the files of LAPACK and BLAS that Simbody calls in this process, with their folders' names alone:
/// "lapack/liblapack.so.3.11.0, blas/libblas.so.3.11.0".
std::string lapackInUse();

}  // namespace ursula
