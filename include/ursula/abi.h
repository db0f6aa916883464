#pragma once

#include <ursula/build.h>

#include <Eigen/Core>
#include <vector>

// Vectors, matrices and standard containers pass the border of the shared library with a layout that compiler options
// determine. A different layout is refused here instead of causing a crash.

static_assert(sizeof(std::vector<double>) == URSULA_VECTOR_SIZE,
              "ursula was built with other containers of the standard library than this file (-D_GLIBCXX_DEBUG changes "
              "them). Compile without it, or build ursula with the same options; -D_GLIBCXX_ASSERTIONS fits.");
static_assert(alignof(Eigen::Matrix<double, 8, 8>) == URSULA_EIGEN_ALIGNMENT,
              "ursula was built with another alignment of Eigen's matrices than this file (AVX options such as "
              "-march=native change it). Compile with -DEIGEN_MAX_STATIC_ALIGN_BYTES=<URSULA_EIGEN_ALIGNMENT of "
              "ursula/build.h>, or build ursula with the same options.");
static_assert(!Eigen::Matrix<double, 3, 3>::IsRowMajor,
              "ursula was built with Eigen's matrices stored by column: EIGEN_DEFAULT_TO_ROW_MAJOR does not fit.");
