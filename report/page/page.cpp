#include "report/page/page.h"

#include "report/page/html_template.h"
#include "report/page/page_data.h"
#include "report/page/sections.h"

namespace ursula::report {

extern const std::string_view figures_html, links_html, page_html, sections_html;  // of web/

namespace {

std::vector<HtmlValue> valuesOf(const std::vector<PageSection>& sections) {
  std::vector<HtmlValue> out;
  for (const auto& [id, title, html] : sections)
    if (!html.empty()) out.push_back({{"id", id}, {"title", title}, {"html", html}});
  return out;
}

}  // namespace

std::string keyFiguresHtml(const std::vector<PageFigure>& figures) {
  return rendered(figures_html,
                  {{"figures", listOf(figures, [](const PageFigure& figure) {
                      return HtmlValue{{"what", figure.what}, {"value", figure.value}, {"remark", figure.remark}};
                    })}});
}

std::string linksHtml(const std::vector<PageSection>& sections) {
  return rendered(links_html, {{"sections", valuesOf(sections)}});
}

std::string sectionsHtml(const std::vector<PageSection>& sections) {
  return rendered(sections_html, {{"sections", valuesOf(sections)}});
}

std::string pageHtml(const Page& page) {
  const bool judges = page.verdict != Verdict::not_applicable;
  return rendered(page_html,
                  {{"kind", page.kind},
                   {"title", page.title},
                   {"style", std::string(report_style).append(page.style)},
                   {"verdict", judges ? name(page.verdict) : "unjudged"},
                   {"subtitle", page.subtitle},
                   {"badge", judges ? verdictBadge(page.verdict) : ""},
                   {"sentence", page.sentence},
                   {"remarks", page.remarks},
                   {"figures", keyFiguresHtml(page.figures)},
                   {"links", linksHtml(page.sections)},
                   {"sections", sectionsHtml(page.sections)},
                   {"footer", page.footer},
                   {"data", page.data.empty() && !page.charts.empty() ? chartData(page.title, page.charts) : page.data},
                   {"script", std::string(page.script)}}) +
         "\n";
}

}  // namespace ursula::report
