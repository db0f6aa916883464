#pragma once

/// \file
/// A ValidationResult as files: summary.json, timeseries.csv, report.html, junit.xml.

#include "include/ursula/abi.h"
#include "report/files/report.h"
#include "report/files/written_files.h"
