#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/plots.h"
#include "validation/verdict/result.h"

namespace ursula::report {

/// One number at the top of a page: name, number, remark. Plain text.
struct PageFigure {
  std::string what, value, remark;
};

struct PageSection {
  std::string id, title;  ///< plain text
  std::string html;       ///< an empty section is omitted
};

/// A page in the report's style, with its own sections below a sentence on the verdict.
struct Page {
  std::string kind;  ///< "Comparison": the kind of page, above its title
  std::string title;
  std::string subtitle;
  Verdict verdict = Verdict::not_applicable;  ///< not_applicable: the page has no verdict and no badge
  std::string sentence;
  std::vector<std::string> remarks;  ///< below the sentence, one line each
  std::vector<PageFigure> figures;
  std::vector<PageSection> sections;
  std::string footer;        ///< HTML
  std::vector<Plot> charts;  ///< drawn by the script in the sections' figures
  std::string_view script;   ///< may be empty
  std::string_view style;    ///< style of its own sections, added to the report's; may be empty
};

/// Returns one file that needs no network; texts are escaped, sections are inserted unchanged.
std::string pageHtml(const Page& page);

}  // namespace ursula::report
