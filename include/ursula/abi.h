#pragma once

#include <ursula/build.h>

#include <Eigen/Core>

// Vectors and matrices cross the border of the shared library by their layout, which Eigen chooses by the compiler's
// options. What is not as in the library is refused here, not found out in a crash.

static_assert(alignof(Eigen::Matrix<double, 8, 8>) == URSULA_EIGEN_ALIGNMENT,
              "ursula was built with another alignment of Eigen's matrices than this file (AVX options such as "
              "-march=native change it). Compile with -DEIGEN_MAX_STATIC_ALIGN_BYTES=<URSULA_EIGEN_ALIGNMENT of "
              "ursula/build.h>, or build ursula with the same options.");
static_assert(!Eigen::Matrix<double, 3, 3>::IsRowMajor,
              "ursula was built with Eigen's matrices stored by column: EIGEN_DEFAULT_TO_ROW_MAJOR does not fit.");
