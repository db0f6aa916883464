#pragma once

/// \file
/// A ValidationResult as files: summary.json, timeseries.csv, report.html, junit.xml.

#include "include/ursula/abi.h"
#include "validation/report/report.h"
#include "validation/report/summary.h"
