#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ursula {

/// A judged scenario: its file as the user named it, and its summary.json, or that of its error.
struct JudgedFile {
  std::string file, summary;
  std::string cause = {};  ///< "likely cause: …"; empty if none is named
};

/// Returns workflow commands of GitHub, a line for each scenario: an error for a failure, a warning for what could not
/// be judged, a notice for a pass.
std::string githubText(const std::vector<JudgedFile>& judged);

/// Returns a SARIF 2.1.0 log: a result for each check that failed or could not be judged.
std::string sarifText(const std::vector<JudgedFile>& judged);

/// Returns what changed since an older summary, in lines: the verdict, checks, the largest deviation, versions. Says so
/// if nothing did. Texts that are no summary count as none.
std::string changesSince(const std::string& older, const std::string& newer);

/// Returns the file's text, or an empty string if it cannot be read.
std::string summaryIn(const std::filesystem::path& folder);

}  // namespace ursula
