// SPDX-FileCopyrightText: 2026 the Sidestep developers
// SPDX-License-Identifier: BSD-3-Clause
// Functions stay short, and comments name what there is.
#include <gtest/gtest.h>

#include "support/source_files.h"

namespace sidestep::testing {
namespace {

struct Function {
  std::string head;
  int line = 0;   ///< of the first word of its head
  int lines = 0;  ///< from there to its closing brace
};

/// A counter of braces: whatever opens after a head with parentheses, in the scope of a file, namespace or class, is a
/// function. Lambdas count with the function around them.
class FunctionFinder {
 public:
  explicit FunctionFinder(const std::string& text) {
    for (const char c : withoutPreprocessor(split(text).code)) take(c);
  }
  std::vector<Function> found;

 private:
  static std::string withoutPreprocessor(const std::string& code) {
    std::string out;
    for (const auto& line : linesOf(code)) {
      const size_t first = line.find_first_not_of(' ');
      out += (first != std::string::npos && line[first] == '#' ? "" : line) + "\n";
    }
    return out;
  }
  bool outside() const { return functions_open_ == 0 && others_open_ == 0; }

  void take(char c) {
    if (c == '{') return open();
    if (c == '}') return close();
    if (c == '\n') ++line_;
    if (c == ';') return head_.clear();
    if (head_.empty() && std::isspace(static_cast<unsigned char>(c))) return;
    if (head_.empty()) head_line_ = line_;
    head_ += c == '\n' ? ' ' : c;
  }

  /// namespace, class, struct, enum, union without parentheses after it; extern "C"
  bool opensScope() const {
    static const std::regex scope("(.*[^A-Za-z_])?(namespace|class|struct|enum|union)([^A-Za-z_(][^()]*)?|extern +");
    return std::regex_match(head_, scope);
  }

  void open() {
    const size_t last = head_.find_last_not_of(' ');
    const bool initializer = head_.find('(') == std::string::npos || head_[last] == '=';
    const char kind = !outside() ? 'o' : opensScope() ? 's' : initializer ? 'o' : 'f';
    if (kind == 'f') found.push_back({head_, head_line_, 0});
    ++openOf(kind);
    open_.push_back(kind);
    head_.clear();
  }

  void close() {
    const char kind = open_.empty() ? 's' : open_.back();
    if (!open_.empty()) open_.pop_back();
    if (kind == 'f') found.back().lines = line_ - found.back().line + 1;
    --openOf(kind);
    head_.clear();
  }

  int& openOf(char kind) { return kind == 'f' ? functions_open_ : kind == 'o' ? others_open_ : scopes_open_; }

  std::string open_, head_;
  int line_ = 1, head_line_ = 1, functions_open_ = 0, others_open_ = 0, scopes_open_ = 0;
};

TEST(Source, NoFunctionIsLongerThan45LinesAndNineInTenAreUnder19) {
  std::vector<int> lengths;
  for (const auto& [file, text] : sourceFiles()) {
    for (const auto& f : FunctionFinder(text).found) {
      EXPECT_LE(f.lines, 45) << file << ":" << f.line << ": " << f.head;
      lengths.push_back(f.lines);
    }
  }
  ASSERT_GT(lengths.size(), 1000u);
  std::sort(lengths.begin(), lengths.end());
  EXPECT_LE(lengths[lengths.size() * 9 / 10], 18) << "of " << lengths.size() << " functions";
}

TEST(Source, TheCounterOfBracesFindsFunctionsAndTheirLengths) {
  const auto found = FunctionFinder(
                         "namespace a {\n"
                         "struct P { int x = 0; double y{1}; };\n"
                         "const char* kBrace = \"{ // \"; // {\n"
                         "int table[] = {f(1), f(2)};\n"
                         "double A::f(int b) const\n"
                         "    : c(b) {\n"
                         "  auto g = [&](int d) { return d; };\n"
                         "  if (b > 1'000) { return '{'; }\n"
                         "}\n"
                         "class B {\n"
                         "  int h() { return 1; }\n"
                         "};\n"
                         "}\n")
                         .found;
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].line, 5);
  EXPECT_EQ(found[0].lines, 5);
  EXPECT_EQ(found[1].line, 11);
  EXPECT_EQ(found[1].lines, 1);
}

/// `Class::member` in comments where one of the two is no word of any code of ours, a line each. Classes of others
/// (mrpt::..., std::...) are not judged.
std::string unknownNames(const std::map<std::string, std::string>& files) {
  static const std::regex word("[A-Za-z_]\\w*"), qualified("(^|[^:\\w])([A-Z]\\w*)::~?(\\w+)");
  std::set<std::string> words;
  for (const auto& [file, text] : files) {
    const std::string code = split(text).code;
    for (std::sregex_iterator it(code.begin(), code.end(), word), end; it != end; ++it) words.insert(it->str());
  }
  std::string out;
  for (const auto& [file, text] : files) {
    const std::string comments = split(text).comments;
    for (std::sregex_iterator it(comments.begin(), comments.end(), qualified), end; it != end; ++it)
      if (words.count((*it)[2]) == 0 || words.count((*it)[3]) == 0)
        out += file + ": " + (*it)[2].str() + "::" + (*it)[3].str() + "\n";
  }
  return out;
}

TEST(Source, NamesInCommentsExist) { EXPECT_EQ(unknownNames(sourceFiles()), ""); }

TEST(Source, ANameInACommentThatDoesNotExistIsFound) {
  EXPECT_EQ(unknownNames({{"a.h", "struct A { int b; };  ///< as A::b, mrpt::C::d, A::c and B::b\n"}}),
            "a.h: A::c\na.h: B::b\n");
}

}  // namespace
}  // namespace sidestep::testing
