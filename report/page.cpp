#include "report/page.h"

#include <fmt/format.h>

#include "report/assets.h"
#include "report/sections.h"
#include "report/text.h"

namespace ursula::report {
namespace {

std::string paragraph(const char* style, const std::string& html) {
  return html.empty() ? "" : fmt::format("<p class=\"{}\">{}</p>\n", style, html);
}

std::string figuresOf(const Page& page) {
  std::string out;
  for (const PageFigure& figure : page.figures)
    out += fmt::format("<div><dt>{}</dt><dd><b>{}</b> <span>{}</span></dd></div>", escaped(figure.what),
                       escaped(figure.value), escaped(figure.remark));
  return out.empty() ? "" : "<dl class=\"figures\">" + out + "</dl>";
}

std::string remarksOf(const Page& page) {
  std::string out;
  for (const std::string& remark : page.remarks) out += paragraph("why", escaped(remark));
  return out;
}

std::string scriptsOf(const Page& page) {
  std::string out;
  if (!page.charts.empty())
    out +=
        fmt::format("<script type=\"application/json\" id=\"data\">{}</script>\n", chartData(page.title, page.charts));
  return page.script.empty() ? out : out + fmt::format("<script>{}</script>\n", page.script);
}

}  // namespace

std::string pageHtml(const Page& page) {
  std::string sections, links;
  for (const auto& [id, title, html] : page.sections) {
    if (html.empty()) continue;
    sections += fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}\n</section>\n", id, escaped(title), html);
    links += fmt::format("<a href=\"#{}\">{}</a>\n", id, escaped(title));
  }
  const bool judges = page.verdict != Verdict::not_applicable;
  return filled(page_template, {{"title", escaped(page.title)},
                                {"heading", escaped(page.kind + ": " + page.title)},
                                {"style", std::string(report_style).append(page.style)},
                                {"verdict", judges ? name(page.verdict) : "unjudged"},
                                {"kind", escaped(page.kind)},
                                {"subtitle", paragraph("machine-line", escaped(page.subtitle))},
                                {"badge", judges ? paragraph("verdict", verdictBadge(page.verdict)) : ""},
                                {"sentence", paragraph("sentence", escaped(page.sentence))},
                                {"remarks", remarksOf(page)},
                                {"figures", figuresOf(page)},
                                {"links", links},
                                {"sections", sections},
                                {"footer", page.footer.empty() ? "" : "<footer>\n" + page.footer + "\n</footer>"},
                                {"scripts", scriptsOf(page)}});
}

}  // namespace ursula::report
