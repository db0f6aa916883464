#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/plots.h"
#include "validation/verdict/result.h"

namespace ursula::report {

/// One number on top of a page: what it is, the number, a remark. Plain text.
struct PageFigure {
  std::string what, value, remark;
};

struct PageSection {
  std::string id, title;  ///< plain text
  std::string html;       ///< left out where it is empty
};

/// A page with the looks of the report, for what is not one: its own sections below a verdict in a sentence.
struct Page {
  std::string kind;  ///< "Comparison": what the page is, above its title
  std::string title;
  std::string subtitle;
  Verdict verdict = Verdict::not_applicable;  ///< not_applicable: the page judges nothing, and has no badge
  std::string sentence;
  std::vector<std::string> remarks;  ///< below the sentence, each a line
  std::vector<PageFigure> figures;
  std::vector<PageSection> sections;
  std::string footer;        ///< HTML
  std::vector<Plot> charts;  ///< drawn by the script where sections hold their figures
  std::string_view script;   ///< may be empty
  std::string_view style;    ///< of its own sections, beside the report's; may be empty
};

/// One file that needs no network; texts are escaped, sections are taken as they are.
std::string pageHtml(const Page& page);

}  // namespace ursula::report
