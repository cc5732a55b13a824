#include "core/sweep/front_chart.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

using namespace pleat;

namespace {

BenchRow point(const StepperType* stepper, double ms, double error) {
  BenchRow row({"converged-00ff", "implicit with eigen, level 2", false});
  row.scene = "swinging sheet";
  row.method.stepper = stepper;
  row.ms_per_frame = ms;
  row.position_error = error;
  return row;
}

int count_of(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// The first thing that keeps a text from being XML, or an empty text: elements that do not close
/// in order, attributes without quotes, and characters that have to be escaped.
std::string xml_fault(const std::string& text) {
  std::vector<std::string> open;
  bool had_root = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if (byte < 0x20 && byte != '\n') return "a control character";
    if (text[i] == '&') {
      const std::string rest = text.substr(i, 6);
      const auto begins = [&](const char* entity) { return rest.rfind(entity, 0) == 0; };
      if (!begins("&amp;") && !begins("&lt;") && !begins("&gt;") && !begins("&quot;"))
        return "a bare &";
    }
    if (text[i] != '<') continue;
    const std::size_t end = text.find('>', i);
    if (end == std::string::npos) return "a tag without end";
    std::string tag = text.substr(i + 1, end - i - 1);
    i = end;
    if (tag[0] == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return "closed out of order: " + tag;
      open.pop_back();
      continue;
    }
    if (open.empty() && had_root) return "two roots";
    had_root = true;
    const bool is_empty = tag.back() == '/';
    if (std::count(tag.begin(), tag.end(), '"') != 2 * std::count(tag.begin(), tag.end(), '='))
      return "quotes in " + tag;
    if (tag.find('<') != std::string::npos) return "a bare <";
    if (!is_empty) open.push_back(tag.substr(0, tag.find(' ')));
  }
  return open.empty() ? "" : "unclosed " + open.back();
}

/// x and y of the corners of the front's line.
std::vector<double> front_corners(const std::string& svg) {
  const std::string begin = "points=\"";
  const std::size_t line = svg.rfind("<polyline", svg.find("class=\"front\""));
  std::vector<double> numbers;
  for (const char* at = svg.c_str() + svg.find(begin, line) + begin.size(); *at != '"';) {
    char* stop = nullptr;
    numbers.push_back(std::strtod(at, &stop));
    at = stop + (*stop == '"' ? 0 : 1);
  }
  return numbers;
}

}  // namespace

TEST_CASE("front figure: a row with a warning has its place off the front, and a line", "[sweep]") {
  std::vector<BenchRow> rows = {point(&steppers::kImplicitEuler, 1, 0.1),
                                point(&steppers::kXpbd, 2, 0.01)};
  rows[0].warnings = {{RunWarning::Kind::stretch, 0.4, VertexId(12), 5, 1, {}}};
  const std::string svg = front_chart(rows);
  CHECK(xml_fault(svg).empty());
  CHECK(count_of(svg, "class=\"mark\"") == 2);
  CHECK(front_corners(svg).size() == 2);
  CHECK(svg.find("cannot explain: 1<") != std::string::npos);
  CHECK(svg.find("stretched by up to 500 %") != std::string::npos);
}

TEST_CASE("front figure: every row has one mark or one line of words", "[sweep]") {
  std::vector<BenchRow> rows = {point(&steppers::kImplicitEuler, 1, 0.1),
                                point(&steppers::kXpbd, 0.1, 0.2),
                                point(&steppers::kXpbd, 0.2, 0.01),
                                point(&steppers::kProjective, 3, 0.05),
                                point(&steppers::kExplicitEuler, 10, 0),
                                point(&steppers::kXpbd, BenchRow::kUnknown, 1),
                                point(&steppers::kXpbd, 1, BenchRow::kUnknown)};
  rows.push_back(point(&steppers::kProjective, 1, 1));
  rows.back().status = "refused";
  rows.back().message = "beyond <its> \"bound\" & \x01more";
  const std::string svg = front_chart(rows);
  CHECK(xml_fault(svg).empty());
  CHECK(count_of(svg, "class=\"mark\"") == 4);
  CHECK(svg.find("Without a place here: 4") != std::string::npos);
  CHECK(svg.find("refused, beyond &lt;its&gt; &quot;bound&quot; &amp; \\u0001more") !=
        std::string::npos);
  CHECK(count_of(svg, "no time was measured") == 1);
  CHECK(count_of(svg, "no error was measured") == 1);
  CHECK(svg.find("Reference, not converged: implicit with eigen, level 2 (converged-00ff)<") !=
        std::string::npos);
  CHECK(svg.find("<script") == std::string::npos);
  CHECK(svg == front_chart(rows));
}

TEST_CASE("front figure: each stepper is drawn and named by its row of the table", "[sweep]") {
  for (const StepperType* type : standard_steppers()) {
    CAPTURE(type->name);
    const std::string svg = front_chart(std::vector<BenchRow>{point(type, 1, 0.1)});
    const std::string mark =
        std::string("d=\"") + type->mark.path + "\" fill=\"" + type->mark.colour + '"';
    CHECK(count_of(svg, mark) == 2);  // once in the plot and once in its legend
    CHECK(count_of(svg, std::string(">") + type->name + "</text>") == 1);
    for (const StepperType* other : standard_steppers())
      if (other != type) CHECK(count_of(svg, other->mark.path) == 0);
  }
}

TEST_CASE("front figure: a decade is as far everywhere, in time as in error", "[sweep]") {
  const std::vector<BenchRow> rows = {point(&steppers::kXpbd, 0.1, 1),
                                      point(&steppers::kXpbd, 1, 0.1),
                                      point(&steppers::kXpbd, 10, 0.01)};
  const std::vector<double> corners = front_corners(front_chart(rows));
  REQUIRE(corners.size() == 6);
  CHECK(corners[2] - corners[0] == Approx(corners[4] - corners[2]).margin(0.02));
  CHECK(corners[3] - corners[1] == Approx(corners[5] - corners[3]).margin(0.02));
  CHECK(corners[0] < corners[2]);  // dearer to the right
  CHECK(corners[1] < corners[3]);  // less wrong further down
}

TEST_CASE("front figure: any numbers give a figure of bounded size", "[sweep]") {
  std::vector<BenchRow> rows;
  CHECK(xml_fault(front_chart(rows)).empty());
  const double scale = GENERATE(1e-300, 1.0, 1e300);
  rows.push_back(point(&steppers::kXpbd, scale, 1e-3 * scale));
  CHECK(xml_fault(front_chart(rows)).empty());
  rows.push_back(point(&steppers::kXpbd, 1, 1));
  const std::string svg = front_chart(rows);
  CHECK(xml_fault(svg).empty());
  CHECK(svg.find("nan") == std::string::npos);
  CHECK(svg.find("inf") == std::string::npos);
  CHECK(svg.size() < 200'000);
}

TEST_CASE("front figure: long lists and names are cut, and the cut is told", "[sweep]") {
  std::vector<BenchRow> rows(100, point(&steppers::kXpbd, 1, BenchRow::kUnknown));
  for (BenchRow& row : rows) row.message = row.scene = std::string(5000, 'x');
  const std::string svg = front_chart(rows);
  CHECK(xml_fault(svg).empty());
  CHECK(svg.find("and 60 more") != std::string::npos);
  CHECK(svg.size() < 30'000);
}
