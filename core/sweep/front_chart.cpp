#include "core/sweep/front_chart.h"
#include "core/base/formatted.h"
#include "core/dynamics/stepper_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace pleat {
namespace {

// Lengths in pixels at 100 %.
constexpr double kWidth = 800;
constexpr double kHeight = 560;  // more where more stands below the plot
constexpr double kLeft = 76;
constexpr double kRight = 780;
constexpr double kTop = 72;
constexpr double kBottom = 464;
constexpr double kLine = 18;           // height of a line
constexpr std::size_t kLetters = 118;  // capacity of a line
constexpr std::size_t kMostListed = 40;

constexpr const char* kFrontColour = "#111";  // line of the front and borders of its marks
constexpr const char* kPlainBorder = "#fff";

std::string xml_text(const std::string& text) {
  const std::map<char, std::string> entities = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string escaped;
  for (const char c : printable(text)) {
    const auto entity = entities.find(c);
    escaped += entity == entities.end() ? std::string(1, c) : entity->second;
  }
  return escaped;
}

/// Whole UTF-8 characters of it.
std::string shortened(const std::string& text, std::size_t n_bytes) {
  if (text.size() <= n_bytes) return text;
  std::size_t length = n_bytes;
  while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0U) == 0x80U) --length;
  return text.substr(0, length) + "...";
}

std::string text_at(double x, double y, const std::string& attributes, const std::string& text) {
  return formatted("<text x=\"%.1f\" y=\"%.1f\"", x, y) + attributes + ">" + xml_text(text) +
         "</text>\n";
}

std::string line_between(double x1, double y1, double x2, double y2, const char* colour) {
  return formatted("<path d=\"M%.2f %.2fL%.2f %.2f\" stroke=\"%s\"/>\n", x1, y1, x2, y2, colour);
}

/// A logarithmic axis over whole decades.
class Axis {
 public:
  /// begin, end  [px]
  Axis(const std::vector<double>& values, double begin, double end) : begin_(begin), end_(end) {
    if (values.empty()) return;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    low_ = static_cast<int>(std::floor(std::log10(*least)));
    high_ = std::max(low_ + 1, static_cast<int>(std::ceil(std::log10(*most))));
  }

  double place(double value) const {  // [px]
    return begin_ + (end_ - begin_) * (std::log10(value) - low_) / (high_ - low_);
  }

  struct Tick {
    double value;
    bool is_decade;
    bool is_labelled;
  };
  std::vector<Tick> ticks() const {
    constexpr int kFewDecades = 2;  // 2 and 5 are labelled too
    constexpr int kMostLabels = 10;
    const int n_decades = high_ - low_;
    const int every = (n_decades + kMostLabels - 1) / kMostLabels;
    std::vector<Tick> ticks;
    for (int decade = low_; decade <= high_; ++decade) {
      const bool is_labelled = (decade - low_) % every == 0;
      ticks.push_back({std::pow(10.0, decade), true, is_labelled});
      for (int factor = 2; factor < 10 && decade < high_ && every == 1; ++factor)
        ticks.push_back({factor * std::pow(10.0, decade), false,
                         n_decades <= kFewDecades && (factor == 2 || factor == 5)});
    }
    return ticks;
  }

 private:
  double begin_;
  double end_;
  int low_ = -1;
  int high_ = 1;
};

/// A row's coordinates in the chart.
struct Place {
  double ms;
  double error;  // [mm]
};

/// Nothing for a row that a logarithmic plot cannot show.
std::optional<Place> place_of(const BenchRow& row) {
  const Place place{row.ms_per_frame, 1e3 * row.position_error};
  const bool is_shown = row.finished() && std::isfinite(place.ms) && std::isfinite(place.error) &&
                        place.ms > 0 && place.error > 0;
  return is_shown ? std::optional<Place>(place) : std::nullopt;
}

std::string reason_for_no_place(const BenchRow& row) {
  if (!row.finished()) return row.status + (row.message.empty() ? "" : ", " + row.message);
  if (!std::isfinite(row.position_error)) return "no error was measured";
  if (row.position_error == 0) return "no error";
  return "no time was measured";
}

std::string grid(const Axis& across, const Axis& up) {
  constexpr const char* kDecadeColour = "#b9b3a9";
  constexpr const char* kMinorColour = "#e6e2db";
  std::string text = "<g stroke-width=\"0.8\" fill=\"none\">\n";
  std::string labels = "<g font-size=\"12\" fill=\"#333\">\n";
  for (const Axis::Tick& tick : across.ticks()) {
    const double x = across.place(tick.value);
    text += line_between(x, kTop, x, kBottom, tick.is_decade ? kDecadeColour : kMinorColour);
    if (tick.is_labelled)
      labels += text_at(x, kBottom + 17, " text-anchor=\"middle\"", formatted("%g", tick.value));
  }
  for (const Axis::Tick& tick : up.ticks()) {
    const double y = up.place(tick.value);
    text += line_between(kLeft, y, kRight, y, tick.is_decade ? kDecadeColour : kMinorColour);
    if (tick.is_labelled)
      labels += text_at(kLeft - 8, y + 4, " text-anchor=\"end\"", formatted("%g", tick.value));
  }
  return text + "</g>\n" + labels + "</g>\n";
}

std::string axis_titles() {
  const double middle = (kTop + kBottom) / 2;
  return text_at((kLeft + kRight) / 2, kBottom + 38, " font-size=\"13\" text-anchor=\"middle\"",
                 "ms per frame (1/60 s of motion)") +
         text_at(22, middle,
                 formatted(" font-size=\"13\" text-anchor=\"middle\" transform=\"rotate(-90 22 "
                           "%.1f)\"",
                           middle),
                 "position error [mm]");
}

std::string mark_at(double x, double y, const StepperMark& mark, const char* border) {
  return formatted("<path transform=\"translate(%.2f %.2f)\" d=\"", x, y) + mark.path +
         "\" fill=\"" + mark.colour + "\" stroke=\"" + border + "\"/>";
}

std::string dashed_line(const std::string& points, const char* attributes) {
  return "<polyline points=\"" + points + "\"" + attributes + " fill=\"none\" stroke=\"" +
         kFrontColour + "\" stroke-width=\"1.4\" stroke-dasharray=\"5 3\"/>\n";
}

std::string legend(std::span<const BenchRow> rows) {
  constexpr double kSpacing = 100;
  constexpr double kY = kTop - 16;
  std::vector<const StepperType*> steppers;
  for (const BenchRow& row : rows)
    if (place_of(row) &&
        std::find(steppers.begin(), steppers.end(), row.method.stepper) == steppers.end())
      steppers.push_back(row.method.stepper);
  std::string text = "<g font-size=\"13\" fill=\"#333\">\n";
  double x = kLeft + 6;
  for (const StepperType* stepper : steppers) {
    text += mark_at(x, kY, stepper->mark, kPlainBorder) + "\n" +
            text_at(x + 10, kY + 4, "", stepper->name);
    x += kSpacing;
  }
  text += dashed_line(formatted("%.0f,%.0f %.0f,%.0f", x - 6, kY, x + 22, kY), "");
  return text + text_at(x + 28, kY + 4, "", "front") + "</g>\n";
}

/// Indices of the rows on a front that have a place.
std::vector<std::size_t> shown(std::span<const BenchRow> rows,
                               const std::vector<std::size_t>& front) {
  std::vector<std::size_t> shown;
  for (const std::size_t i : front)
    if (place_of(rows[i])) shown.push_back(i);
  return shown;
}

std::string front_lines(std::span<const BenchRow> rows, const Axis& across, const Axis& up) {
  std::string lines;
  for (const std::vector<std::size_t>& front : fronts_of(rows)) {
    std::string points;
    for (const std::size_t i : shown(rows, front)) {
      const Place place = *place_of(rows[i]);
      if (!points.empty()) points += ' ';
      points += formatted("%.2f,%.2f", across.place(place.ms), up.place(place.error));
    }
    if (!points.empty()) lines += dashed_line(points, " class=\"front\"");
  }
  return lines;
}

std::string marks(std::span<const BenchRow> rows, const Axis& across, const Axis& up) {
  const std::vector<std::size_t> front = shown(rows, front_of(rows));
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto place = place_of(rows[i]);
    if (!place) continue;
    const bool is_on_front = std::find(front.begin(), front.end(), i) != front.end();
    text += "<g class=\"mark\"><title>" + xml_text(setting_phrase(rows[i])) +
            formatted(": %.3g ms, %.3g mm", place->ms, place->error) + "</title>" +
            mark_at(across.place(place->ms), up.place(place->error), rows[i].method.stepper->mark,
                    is_on_front ? kFrontColour : kPlainBorder) +
            "</g>\n";
  }
  return text;
}

/// The first of the items, and how many more there are.
void append_listed(const std::vector<std::string>& items, std::vector<std::string>& lines) {
  const std::size_t n_listed = std::min(items.size(), kMostListed);
  lines.insert(lines.end(), items.begin(), items.begin() + static_cast<std::ptrdiff_t>(n_listed));
  if (items.size() > n_listed)
    lines.push_back("and " + std::to_string(items.size() - n_listed) + " more");
}

/// The lines below the plot.
std::vector<std::string> notes(std::span<const BenchRow> rows) {
  std::vector<std::string> references;
  std::vector<std::string> without_place;
  std::vector<std::string> warned;
  std::set<std::string> known;
  for (const BenchRow& row : rows) {
    const ReferenceLabel& label = row.reference;
    if (known.insert(label.id).second)
      references.push_back("Reference, " +
                           std::string(label.converged ? "converged" : "not converged") + ": " +
                           label.description + " (" + label.id + ")");
    if (!place_of(row))
      without_place.push_back(setting_phrase(row) + ": " + reason_for_no_place(row));
    if (!row.is_plausible())
      warned.push_back(setting_phrase(row) + ": " + sentence(row.warnings.front()));
  }
  std::vector<std::string> lines;
  append_listed(references, lines);
  if (!without_place.empty())
    lines.push_back("Without a place here: " + std::to_string(without_place.size()));
  append_listed(without_place, lines);
  if (!warned.empty())
    lines.push_back("On no front, as the run shows what its scene cannot explain: " +
                    std::to_string(warned.size()));
  append_listed(warned, lines);
  return lines;
}

}  // namespace

std::string front_chart(std::span<const BenchRow> rows) {
  constexpr double kNotesTop = kBottom + 68;
  constexpr std::size_t kTitleLetters = 70;
  std::vector<double> times;
  std::vector<double> errors;
  for (const BenchRow& row : rows)
    if (const auto place = place_of(row)) {
      times.push_back(place->ms);
      errors.push_back(place->error);
    }
  const Axis across(times, kLeft, kRight);
  const Axis up(errors, kBottom, kTop);
  const std::vector<std::string> lines = notes(rows);
  const double height = std::max(kHeight, kNotesTop + kLine * static_cast<double>(lines.size()));
  const std::string title =
      shortened(rows.empty() ? "" : rows.front().scene, kTitleLetters) + ": speed and error";

  std::string svg = formatted(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" "
      "height=\"%.0f\" font-family=\"sans-serif\" role=\"img\">\n",
      kWidth, height, kWidth, height);
  svg += "<title>" + xml_text(title) + "</title>\n";
  svg += "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  svg += text_at(kLeft, 30, " font-size=\"18\" fill=\"#111\"", title);
  svg += legend(rows) + grid(across, up) + axis_titles();
  svg += front_lines(rows, across, up) + marks(rows, across, up);
  svg += "<g font-size=\"12\" fill=\"#333\">\n";
  for (std::size_t n = 0; n < lines.size(); ++n)
    svg += text_at(kLeft, kNotesTop + kLine * static_cast<double>(n), "",
                   shortened(lines[n], kLetters));
  return svg + "</g>\n</svg>\n";
}

}  // namespace pleat
