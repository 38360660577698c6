// SPDX-License-Identifier: MIT
// kaustik doc: no node lacks a page, and no page what the node, its stage and its parameters
// declare. The stages' table in framework/README.md says the same.
#include <cctype>
#include <map>
#include <regex>
#include <sstream>

#include "framework/core/files.h"
#include "tests/cli/fixture.h"

namespace kaustik::test {
namespace {

using nlohmann::json;

class Doc : public CommandLine {
  protected:
    [[nodiscard]] json list(const std::string& what) const {
        return json::parse(run({"list", what, "--json"}).out);
    }
    void writePages() const {
        const Outcome outcome = run({"doc", "--out", "pages"});
        ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    }
    [[nodiscard]] std::string page(const std::string& node) const {
        return contents("pages/" + node + ".md");
    }
};

// The cells of a row of a table in Markdown, without the spaces around them.
std::vector<std::string> cellsOf(const std::string& row) {
    std::vector<std::string> cells;
    std::string cell;
    const auto finish = [&] {
        const std::size_t first = cell.find_first_not_of(' ');
        const std::size_t last = cell.find_last_not_of(' ');
        cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
        cell.clear();
    };
    for (std::size_t i = 1; i < row.size(); ++i) {
        const bool isEscaped = row[i] == '|' && row[i - 1] == '\\';
        if (isEscaped) cell.back() = '|';
        if (row[i] == '|' && !isEscaped) {
            finish();
        } else if (!isEscaped) {
            cell += row[i];
        }
    }
    return cells;
}

// By the first cell, the others of all rows of all tables.
std::map<std::string, std::vector<std::string>> rowsOf(const std::string& text) {
    std::map<std::string, std::vector<std::string>> rows;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("| ")) continue;
        std::vector<std::string> cells = cellsOf(line);
        const std::string first = cells.front();
        cells.erase(cells.begin());
        rows[first] = std::move(cells);
    }
    return rows;
}

bool isSentence(const std::string& text) {
    return text.size() > 10 && text.ends_with('.') &&
           std::isupper(static_cast<unsigned char>(text.front())) != 0;
}

TEST_F(Doc, WritesAPageForEachNodeThatSaysWhatItDoesAndWhatItCannot) {
    writePages();
    std::set<std::string> expected = {"pages/index.md"};
    for (const json& node : list("nodes")) {
        const std::string name = node.at("name");
        SCOPED_TRACE(name);
        expected.insert("pages/" + name + ".md");
        const std::string sentence = node.at("description");
        const std::string limits = node.at("limits");
        const std::string source = node.at("source");
        EXPECT_TRUE(isSentence(sentence)) << sentence;
        EXPECT_TRUE(isSentence(limits)) << limits;
        const std::string text = page(name);
        EXPECT_TRUE(text.starts_with("# " + name + "\n\n" + sentence + "\n")) << text;
        EXPECT_NE(text.find("\n## Limits\n\n" + limits + "\n"), std::string::npos) << text;
        const auto rows = rowsOf(text);
        EXPECT_EQ(rows.at("source").front(), source.empty() ? "our own" : source);
        EXPECT_NE(contents("pages/index.md").find("[" + name + "](" + name + ".md): " + sentence),
                  std::string::npos);
    }
    EXPECT_EQ(files(), expected);
}

TEST_F(Doc, HasEachParameterWithSentenceUnitRangeAndDefaultOnThePagesOfItsNodes) {
    writePages();
    std::map<std::string, std::vector<std::string>> nodesOf;  // by stage, and by their own names
    for (const json& node : list("nodes")) {
        nodesOf[node.at("stage")].push_back(node.at("name"));
        nodesOf[node.at("name")].push_back(node.at("name"));
    }
    int parameters = 0;
    for (const json& parameter : list("params")) {
        const std::string name = parameter.at("name");
        const std::size_t dot = name.rfind('.');
        if (dot == std::string::npos) continue;  // which node answers a stage
        SCOPED_TRACE(name);
        ++parameters;
        const std::string sentence = parameter.at("description");
        const std::string range = parameter.at("range");
        EXPECT_GT(sentence.size(), 10u);
        EXPECT_FALSE(range.empty());
        const std::string unit = parameter.at("unit");
        ASSERT_FALSE(nodesOf[name.substr(0, dot)].empty());
        for (const std::string& node : nodesOf[name.substr(0, dot)]) {
            const auto rows = rowsOf(page(node));
            ASSERT_TRUE(rows.contains("`" + name + "`")) << node;
            const std::vector<std::string>& cells = rows.at("`" + name + "`");
            ASSERT_EQ(cells.size(), 4u);
            EXPECT_FALSE(cells[0].empty());
            EXPECT_EQ(cells[1], unit.empty() ? "–" : unit);
            EXPECT_EQ(cells[2], range);
            EXPECT_EQ(cells[3], sentence);
        }
    }
    EXPECT_GT(parameters, 50);
}

TEST_F(Doc, SaysOfEachStageWhatTheTableInTheReadmeDoes) {
    writePages();
    std::map<std::string, std::string> declared;
    for (const json& node : list("nodes")) {
        const auto rows = rowsOf(page(node.at("name")));
        declared["`" + node.at("stage").get<std::string>() + "`"] =
            rows.at("takes").front() + " → " + rows.at("gives").front();
    }
    const std::string readme = readFile(projectRoot() / "framework/README.md");
    const std::size_t begin = readme.find("| stage | takes → gives |");
    ASSERT_NE(begin, std::string::npos);
    auto rows = rowsOf(readme.substr(begin, readme.find("\n\n", begin) - begin));
    EXPECT_EQ(rows.erase("stage") + rows.erase("---"), 2u);
    std::map<std::string, std::string> written;
    for (const auto& [stage, cells] : rows)
        written[stage] = cells.front();
    EXPECT_EQ(written, declared);
}

// "- NAME: CITATION" of the chapter at a page's end; empty where there is none.
std::map<std::string, std::string> papersOf(const std::string& text) {
    std::map<std::string, std::string> papers;
    const std::size_t begin = text.find("\n## Papers\n\n");
    if (begin == std::string::npos) return papers;
    std::istringstream lines(text.substr(begin + 12));
    for (std::string line; std::getline(lines, line);) {
        const std::size_t colon = line.find(": ");
        if (!line.starts_with("- ") || colon == std::string::npos) continue;
        papers[line.substr(2, colon - 2)] = line.substr(colon + 2);
    }
    return papers;
}

TEST_F(Doc, SpellsOutThePapersThatAPageCitesAsTheBibliographyDoes) {
    const std::string text = readFile(projectRoot() / "techniques/papers.md");
    std::map<std::string, std::string> bibliography;
    for (const auto& [name, cells] : rowsOf(text.substr(text.find("\n## Bibliography\n")))) {
        if (name != "name" && name != "---") bibliography[name] = cells.front();
    }
    EXPECT_GT(bibliography.size(), 5u);
    writePages();
    EXPECT_EQ(papersOf(contents("pages/index.md")), bibliography);
    int citing = 0;
    for (const json& node : list("nodes")) {
        SCOPED_TRACE(node.at("name"));
        const std::string whole = page(node.at("name"));
        const std::string body = whole.substr(0, whole.find("\n## Papers\n"));
        std::map<std::string, std::string> cited;
        for (const auto& [name, citation] : bibliography) {
            if (std::regex_search(body, std::regex("\\b" + name + "\\b"))) cited[name] = citation;
        }
        EXPECT_EQ(papersOf(whole), cited);
        citing += cited.empty() ? 0 : 1;
    }
    EXPECT_GT(citing, 20);
}

TEST_F(Doc, NamesTheTechniquesWhoseRowChoosesTheNodeAndNoOther) {
    writePages();
    std::map<std::string, std::set<std::string>> rowsWith;  // by node
    std::set<std::string> techniques;
    for (const json& technique : list("techniques")) {
        techniques.insert(technique.at("name"));
        for (const auto& [name, value] : technique.at("defaults").items())
            rowsWith[name + "." + value.get<std::string>()].insert(technique.at("name"));
    }
    std::map<std::string, int> defaults;  // by stage
    for (const json& node : list("nodes")) {
        SCOPED_TRACE(node.at("name"));
        const std::string cell = rowsOf(page(node.at("name"))).at("in the row of").front();
        std::set<std::string> named;
        for (const std::string& technique : techniques) {
            if (cell.find("`" + technique + "`") != std::string::npos) named.insert(technique);
        }
        EXPECT_EQ(named, rowsWith[node.at("name")]) << cell;
        EXPECT_EQ(cell.find("no technique") != std::string::npos, named.empty()) << cell;
        defaults[node.at("stage")] += cell.find("where a row says nothing") != std::string::npos;
    }
    for (const auto& [stage, count] : defaults)
        EXPECT_EQ(count, 1) << stage;
}

TEST_F(Doc, WritesWholeNumbersWithAllTheirDigits) {
    const std::string grid = run({"doc", "emit.grid"}).out;
    EXPECT_NE(grid.find("| 1 to 268435456 |"), std::string::npos) << grid;
    EXPECT_NE(run({"list", "params"}).out.find("[1 to 268435456]"), std::string::npos);
    for (const json& parameter : list("params")) {
        EXPECT_EQ(parameter.at("range").get<std::string>().find("e+"), std::string::npos)
            << parameter;
    }
    expectFailure(run({"explain", "ring", "--set", "emit.batch=0"}), 2,
                  {"emit.batch", "a whole number from 1 to 268435456"});
}

// "The same for the reflection …" is said after what it is the same as.
TEST_F(Doc, HasParametersInTheOrderOfTheirDeclaration) {
    const std::string text = run({"doc", "view.refraction"}).out;
    const std::size_t scene = text.find("| `view.refraction.scene` |");
    const std::size_t reflection = text.find("| `view.refraction.reflection` |");
    ASSERT_NE(reflection, std::string::npos);
    EXPECT_LT(scene, reflection);
}

// GitHub's rule: lower case, without punctuation, blanks as hyphens.
std::string anchorOf(const std::string& heading) {
    std::string anchor;
    for (const char c : heading) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == ' ') anchor += '-';
        if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80)
            anchor += static_cast<char>(std::tolower(byte));
    }
    return anchor;
}

TEST(Documents, LinkToHeadingsThatTheyHave) {
    int links = 0;
    for (const char* folder : {".", "framework", "techniques", "experiments", "results"}) {
        for (const auto& entry : std::filesystem::directory_iterator(projectRoot() / folder)) {
            if (entry.path().extension() != ".md") continue;
            const std::string text = readFile(entry.path());
            std::set<std::string> anchors;
            std::istringstream lines(text);
            for (std::string line; std::getline(lines, line);) {
                const std::size_t begin = line.find_first_not_of('#');
                if (begin != 0 && begin != std::string::npos && line[begin] == ' ')
                    anchors.insert(anchorOf(line.substr(begin + 1)));
            }
            const std::regex link("\\]\\(#([^)]+)\\)");
            for (std::sregex_iterator found(text.begin(), text.end(), link), end; found != end;
                 ++found) {
                EXPECT_TRUE(anchors.contains((*found)[1])) << entry.path() << ": " << (*found)[1];
                ++links;
            }
        }
    }
    EXPECT_GT(links, 5);
}

TEST(Papers, NameFilesThatAreThere) {
    const std::string text = readFile(projectRoot() / "techniques/papers.md");
    const std::regex file("`([a-z_/]+/[a-z0-9_]+\\.(cpp|h|glsl|comp|frag|vert|geom))`");
    int count = 0;
    for (std::sregex_iterator found(text.begin(), text.end(), file), end; found != end; ++found) {
        const std::string name = (*found)[1];
        const auto isIn = [&](const char* folder) {
            return std::filesystem::exists(projectRoot() / folder / name);
        };
        EXPECT_TRUE(isIn("techniques") || isIn("shaders") || isIn(".")) << name;
        ++count;
    }
    EXPECT_GT(count, 50);
}

TEST_F(Doc, PrintsOnePageThatIsTheOneItWrites) {
    writePages();
    const Outcome whole = run({"doc", "trace.secant"});
    EXPECT_EQ(whole.exitCode, 0) << whole.err;
    EXPECT_EQ(whole.out, page("trace.secant"));
    EXPECT_NE(whole.out.find("`caustic_triangles`"), std::string::npos);
    EXPECT_EQ(run({"doc", "secant"}).out, whole.out);
    EXPECT_EQ(run({"doc", "secant", "--out", "one"}).exitCode, 0);
    EXPECT_EQ(contents("one/trace.secant.md"), whole.out);
}

TEST_F(Doc, RefusesANodeThatIsNotThereOrNotTheOnlyOneOfItsName) {
    expectFailure(run({"doc", "trace.secants"}), 2, {"trace.secants", "trace.secant'"});
    expectFailure(run({"doc", "secants"}), 2, {"secants", "secant"});
    expectFailure(run({"doc", "deferred"}), 2,
                  {"emit.deferred", "specular.deferred", "view.deferred"});
}

}  // namespace
}  // namespace kaustik::test
