// unit: what a project owes who picks it up: notices of every library, links that lead somewhere, an index of all
// pages.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/paths.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

std::string text_of_file(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<fs::path> pages() {
  std::vector<fs::path> files{source_dir() + "/README.md", source_dir() + "/CHANGELOG.md",
                              source_dir() + "/config/examples/README.md"};
  for (const auto& entry : fs::directory_iterator(source_dir() + "/docs"))
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  return files;
}

TEST(Project, NoticesNameEveryLibraryThatIsNotForTests) {
  const std::string notices = text_of_file(source_dir() + "/THIRD-PARTY.md");
  std::ifstream packages(source_dir() + "/packages.txt");
  int named = 0;
  for (std::string line; std::getline(packages, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string package, kind;
    if (!(words >> package) || (words >> kind && kind != "run"))
      continue;  // what is neither built with nor driven with
    ++named;
    EXPECT_NE(notices.find(package), std::string::npos) << package << " of packages.txt is not in THIRD-PARTY.md";
  }
  EXPECT_GT(named, 25);
  EXPECT_NE(text_of_file(source_dir() + "/LICENSE").find("Apache License\n                           Version 2.0"),
            std::string::npos);
}

TEST(Project, LinksLeadSomewhere) {
  const std::regex link(R"(\]\(([^)#]+)(#[^)]*)?\))");
  int links = 0;
  for (const fs::path& page : pages()) {
    const std::string text = text_of_file(page);
    for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) {
      const std::string target = (*at)[1];
      if (target.starts_with("http")) continue;
      ++links;
      EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page << " links to " << target;
    }
  }
  EXPECT_GT(links, 30);
}

// "Checked by tests/…" of a source or a page is a file that is there.
TEST(Project, EveryTestThatIsNamedIsThere) {
  const std::regex test(R"((?:python/)?tests/[A-Za-z0-9_/]+\.(?:cpp|sh|py))");
  std::vector<fs::path> files = pages();
  for (const char* folder : {"cockpit_io", "config", "net", "shaders", "tools", "vehicle_dynamics", "visual"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(source_dir()) / folder))
      if (const auto kind = entry.path().extension(); kind == ".h" || kind == ".cpp" || kind == ".glsl")
        files.push_back(entry.path());
  int named = 0;
  for (const fs::path& file : files) {
    const std::string text = text_of_file(file);
    for (std::sregex_iterator at(text.begin(), text.end(), test), end; at != end; ++at, ++named)
      EXPECT_TRUE(fs::exists(fs::path(source_dir()) / at->str())) << file << " names " << at->str();
  }
  EXPECT_GT(named, 50) << "the pattern finds them";
}

TEST(Project, EveryPageIsInTheIndexAndBeginsWithWhatCanBeDoneAfterIt) {
  const std::string index = text_of_file(source_dir() + "/docs/README.md");
  for (const auto& entry : fs::directory_iterator(source_dir() + "/docs")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".md" || name == "README.md") continue;
    EXPECT_NE(index.find("(" + name + ")"), std::string::npos) << name << " is not in docs/README.md";
    const std::string text = text_of_file(entry.path());
    const std::string first = text.substr(std::min(text.find("\n\n"), text.size() - 2) + 2, 200);
    EXPECT_TRUE(first.starts_with("After ") && first.find(" you ") < 100) << name << ": " << first;
  }
}

}  // namespace
}  // namespace phare
