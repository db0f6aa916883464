#pragma once

/// \file
/// A ValidationResult as files: summary.json, timeseries.csv, report.html, junit.xml.

#include "include/ursula/abi.h"
#include "report/report.h"
#include "report/written_files.h"
