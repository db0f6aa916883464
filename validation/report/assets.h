#pragma once

#include <string_view>

namespace ursula::report {

// Generated at build time from web/.
extern const std::string_view report_template;  ///< web/report.html
extern const std::string_view index_template;   ///< web/index.html
extern const std::string_view report_style;     ///< web/style.css with that of uPlot
extern const std::string_view report_script;    ///< web/main.js with uPlot

}  // namespace ursula::report
