#include "report/plots.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/text.h"

namespace ursula::report {

std::string figureHtml(const Plot& plot, std::size_t index, const char* heading, Drawing drawing) {
  const bool drawable =
      std::any_of(plot.lines.begin(), plot.lines.end(), [&plot](const Line& line) { return isDrawable(plot, line); });
  return fmt::format("<figure><figcaption><{0}>{1}</{0}><p>{2}</p></figcaption>{3}</figure>\n", heading,
                     escaped(plot.title), escaped(inWords(plot)),
                     drawable ? fmt::format("<div class=\"chart\" data-plot=\"{}\">{}</div>", index,
                                            drawing == Drawing::with ? svgPlot(plot) : "")
                              : "");
}

std::string figuresHtml(const std::vector<Plot>& plots, PlotGroup group) {
  std::string out;
  for (std::size_t i = 0; i < plots.size(); ++i)
    if (plots[i].group == group) out += figureHtml(plots[i], i, "h3");
  return out.empty() ? "" : "<div class=\"charts\">\n" + out + "</div>";
}

}  // namespace ursula::report
