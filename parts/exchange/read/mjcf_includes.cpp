// <include> of MJCF: the children of another file's root in its place, as MuJoCo has it.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"
#include "base/text_source.h"
#include "parts/exchange/read/xml.h"

namespace ursula::exchange {
namespace {

constexpr std::size_t most_included = 50;

class Includer {
 public:
  Includer(tinyxml2::XMLDocument& document, const std::filesystem::path& file)
      : document_(document), folder_(file.parent_path()) {
    taken_.insert(file.filename().lexically_normal());
  }

  void visit(Element& element) {
    for (Element* child = element.FirstChildElement(); child != nullptr;) {
      if (std::string(child->Name()) == "include") {
        Element* next = take(*child);
        element.DeleteChild(child);
        child = next;
      } else {
        visit(*child);
        child = child->NextSiblingElement();
      }
    }
  }

 private:
  /// Returns the element to go on with, the first one of the file that is put in.
  Element* take(Element& include) {
    const std::filesystem::path file = fileOf(include);
    tinyxml2::XMLDocument inner;
    parse(include, file, inner);
    tinyxml2::XMLNode* last = &include;
    for (const tinyxml2::XMLNode* node = inner.RootElement()->FirstChild(); node != nullptr; node = node->NextSibling())
      last = include.Parent()->InsertAfterChild(last, node->DeepClone(&document_));
    return include.NextSiblingElement();
  }

  std::filesystem::path fileOf(const Element& include) {
    const std::string name = requiredAttribute(include, "file");
    const auto refuseIt = [&](const char* why) {
      refuse(include, fmt::format("includes {}, which {}; make one file of it: mj_saveLastXML, or MuJoCo's compile "
                                  "FILE.xml ONE.xml",
                                  shown(name), why));
    };
    const std::filesystem::path normal = std::filesystem::path(name).lexically_normal();
    std::filesystem::path file = folder_ / name;
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) refuseIt("is not read, as it does not lie beside the model");
    if (normal.is_absolute() || *normal.begin() == "..") refuseIt("is not read, as it lies out of the model's folder");
    requireInFolder(file, folder_);
    if (!taken_.insert(normal).second) refuseIt("is included twice, as MuJoCo does not allow");
    if (taken_.size() > most_included) refuseIt("is one too many to be read");
    return file;
  }

  void parse(const Element& include, const std::filesystem::path& file, tinyxml2::XMLDocument& inner) {
    const std::string name = shown(file.filename().string());
    try {
      const std::string text = readText(file, {most_model_bytes - bytes_, "the files of a model"});
      bytes_ += text.size();
      requireModest(text);
      parseXml(text, inner);
    } catch (const ImportError& error) {
      throw ImportError(fmt::format("{}:{}: {}", name, error.line, error.what()), include.GetLineNum());
    } catch (const TextRefusal& error) {
      refuse(include, fmt::format("{}: {}", name, error.what()));
    }
    const std::string root = inner.RootElement()->Name();
    if (root != "mujoco" && root != "mujocoinclude")
      refuse(include,
             fmt::format("includes {}, whose root is <{}>, expected <mujocoinclude> or <mujoco>", name, shown(root)));
  }

  tinyxml2::XMLDocument& document_;
  std::filesystem::path folder_;
  std::set<std::filesystem::path> taken_;
  std::size_t bytes_ = 0;
};

}  // namespace

void requireInFolder(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const std::filesystem::path whole = std::filesystem::canonical(std::filesystem::absolute(folder / "."));
  const std::filesystem::path real = std::filesystem::canonical(file);
  if (std::mismatch(whole.begin(), whole.end(), real.begin(), real.end()).first != whole.end())
    throw ImportError(fmt::format("{} beside it is a link that leads out of its folder, expected a file in it",
                                  file.filename().string()));
}

void takeIncludes(tinyxml2::XMLDocument& document, const std::filesystem::path& file) {
  Includer(document, file).visit(*document.RootElement());
}

}  // namespace ursula::exchange
