#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "apps/verbs.h"
#include "base/child_process.h"
#include "report/files/run.h"

namespace ursula {
namespace {

std::filesystem::path pageIn(const std::filesystem::path& folder) {
  for (const char* page : {"report.html", "index.html"})
    if (std::filesystem::is_regular_file(folder / page)) return std::filesystem::absolute(folder / page);
  if (!std::filesystem::is_directory(folder))
    throw UsageError(fmt::format("{}: no such folder, expected a folder of results", folder.string()));
  throw UsageError(
      fmt::format("{} has neither report.html nor index.html, expected a folder of results", folder.string()));
}

bool isInPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string folders = path == nullptr ? "" : path;
  for (std::size_t start = 0; start <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', start), folders.size());
    const std::string file = folders.substr(start, end - start) + "/" + program;
    if (::access(file.c_str(), X_OK) == 0) return true;
    start = end + 1;
  }
  return false;
}

/// Returns a command for `sh -c` with the page as $1 instead of each %s, quoted or not. The page is one word for any
/// path.
std::string withPage(const std::string& browser) {
  std::string out;
  char quote = '\0';
  for (std::size_t k = 0; k < browser.size(); ++k) {
    const char sign = browser[k];
    if (browser.compare(k, 2, "%s") == 0) {
      out += quote == '"' ? "${1}" : quote == '\'' ? "'\"$1\"'" : "\"$1\"";
      ++k;
      continue;
    }
    out += sign;
    if (sign == '\\' && quote != '\'' && k + 1 < browser.size())
      out += browser[++k];
    else if (sign == quote)
      quote = '\0';
    else if (quote == '\0' && (sign == '"' || sign == '\''))
      quote = sign;
  }
  return out;
}

/// Returns a command for `sh -c` with the page as $1: the first of $BROWSER, possibly with %s, else xdg-open; "" if
/// there is neither.
std::string browserCommand() {
  const char* browser = std::getenv("BROWSER");
  std::string command = browser == nullptr ? "" : browser;
  command.erase(std::min(command.find(':'), command.size()));
  if (command.empty()) return isInPath("xdg-open") ? "exec xdg-open \"$1\"" : "";
  return command.find("%s") == std::string::npos ? command + " \"$1\"" : withPage(command);
}

int openResults(const std::string& folder) {
  const std::string page = pageIn(folder).string();
  report::refuseMixture(folder);
  writeOutput("-", page + "\n");
  if (!showPage(page))
    throw UsageError("no browser: neither $BROWSER nor xdg-open is there; open the page above yourself");
  return exit_passed;
}

}  // namespace

bool showPage(const std::string& page) {
  const std::string command = browserCommand();
  if (!command.empty()) startDetached({"/bin/sh", "-c", command, "sh", page});
  return !command.empty();
}

void addOpen(CLI::App& app, std::function<int()>& run) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand("open", "Shows the report of a results folder in the browser");
  verb->group(reading);
  verb->add_option("folder", *folder, "Folder with report.html, or with index.html if it holds a suite")->required();
  verb->footer(
      "Example: ursula open results/my\n"
      "Prints the page's path and starts $BROWSER, else xdg-open, without waiting for it.");
  verb->callback([folder, &run] { run = [folder] { return openResults(*folder); }; });
}

}  // namespace ursula
