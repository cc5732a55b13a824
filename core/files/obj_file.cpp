#include "core/files/obj_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>

#include "core/base/check.h"
#include "core/files/json_reader.h"
#include "core/mesh/mesh_fault.h"

namespace pleat {
namespace {

constexpr std::string_view kBlanks = " \t\v\f";

/// Statements of OBJ that a simulation has no use for.
constexpr std::string_view kPassedOver[] = {
    "vn",    "vp",       "s",        "usemtl", "mtllib",     "usemap",   "maplib",
    "bevel", "c_interp", "d_interp", "lod",    "shadow_obj", "trace_obj"};

/// Statements that make curves and surfaces.
constexpr std::string_view kFreeForm[] = {
    "cstype", "deg", "bmat", "step",  "curv",  "curv2", "surf", "parm", "trim", "hole", "scrv",
    "sp",     "end", "con",  "ctech", "stech", "mg",    "bsp",  "bzp",  "cdc",  "cdp",  "res"};

bool is_among(std::span<const std::string_view> words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// A name with U+FFFD for bytes that are no UTF-8, so that it can stand in a scene file.
std::string as_utf8(const std::string& text) {
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// Words of a line up to a comment, which a "#" at the start of a word opens.
std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t at = line.find_first_not_of(kBlanks);
  while (at != std::string_view::npos && line[at] != '#') {
    const std::size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

/// Calls `take(line, number)` for every line. One that ends in a backslash goes on in the next,
/// unless it is a comment, which may end in the name of a folder.
template <class Take>
void for_each_line(std::string_view text, Take&& take) {
  int number = 1;
  std::string line;
  for (std::size_t at = 0; at < text.size();) {
    const int first = number;
    line.clear();
    bool goes_on = true;
    while (goes_on && at < text.size()) {
      const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
      line += text.substr(at, end - at);
      at = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
      ++number;
      goes_on = !line.empty() && line.back() == '\\' && line.front() != '#';
      if (goes_on) line.back() = ' ';
    }
    take(line, first);
  }
}

struct Corner {
  VertexId vertex;
  std::optional<std::size_t> texture;
};

/// Takes a text line by line.
class ObjParser {
 public:
  void take(std::string_view line, int number);
  ObjMesh finish();

 private:
  [[noreturn]] void fail(const std::string& expected, const std::string& got) const {
    throw InputError("line " + std::to_string(line_), "expected " + expected + ", got " + got);
  }

  std::int64_t n_vertices() const { return static_cast<std::int64_t>(vertex_lines_.size()); }
  Vec3 position(VertexId v) const { return Eigen::Map<const Vec3>(&coordinates_[3 * v]); }

  double number(std::string_view word) const;
  std::vector<double> numbers(std::size_t at_least) const;
  std::int64_t whole_number(std::string_view text, const char* what) const;
  std::int64_t index(std::string_view text, std::int64_t count, const char* what) const;
  Corner corner(std::string_view word) const;
  std::vector<Corner> corners(std::size_t at_least) const;
  void check_face(const std::vector<Corner>& face) const;
  void check_fan(const std::vector<Corner>& face) const;
  void add_to_groups(const std::vector<Corner>& element);
  void take_vertex();
  void take_face();
  void take_names();

  int line_ = 0;
  std::vector<std::string_view> words_;  // words of the line
  std::vector<double> coordinates_;
  std::vector<int> vertex_lines_;
  std::vector<Eigen::Vector2d> texture_coordinates_;
  std::string object_;                    // empty when none is named
  std::vector<std::string> group_names_;  // groups of the elements that come
  std::map<std::string, std::size_t> group_places_;
  std::map<std::string, int> skipped_;  // statements by their keyword
  ObjMesh mesh_;
};

double ObjParser::number(std::string_view word) const {
  const std::string text(word);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  // strtod takes "nan", "inf" and "0x1p3" too.
  if (*end != '\0' || text.find_first_not_of("+-.0123456789eE") != std::string::npos)
    fail("a number", quotation(word));
  if (!(std::abs(value) <= kLargestNumber))
    fail("a number of at most 1e12 in size", quotation(word));
  return value;
}

std::vector<double> ObjParser::numbers(std::size_t at_least) const {
  std::vector<double> values;
  for (std::size_t k = 1; k < words_.size(); ++k) values.push_back(number(words_[k]));
  if (values.size() < at_least)
    fail("at least " + std::to_string(at_least) + (at_least == 1 ? " number" : " numbers"),
         std::to_string(values.size()));
  return values;
}

std::int64_t ObjParser::whole_number(std::string_view text, const char* what) const {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || at != end)
    fail(std::string("the number of a ") + what, quotation(text));
  return value;
}

/// Counted from 0. In the text, 1 is the first and -1 the last so far.
std::int64_t ObjParser::index(std::string_view text, std::int64_t count, const char* what) const {
  const std::int64_t given = whole_number(text, what);
  const std::int64_t value = given > 0 ? given - 1 : count + given;
  if (given == 0 || value < 0 || value >= count)
    fail(std::string("the number of a ") + what + ", 1 to " + std::to_string(count) +
             " or as many back from -1, as so many stand above",
         quotation(text));
  return value;
}

/// "vertex", "vertex/texture", "vertex//normal" or "vertex/texture/normal".
Corner ObjParser::corner(std::string_view word) const {
  const std::size_t slash = std::min(word.find('/'), word.size());
  Corner corner{VertexId(index(word.substr(0, slash), n_vertices(), "vertex")), std::nullopt};
  if (slash == word.size()) return corner;
  const std::string_view rest = word.substr(slash + 1);
  const std::size_t second_slash = std::min(rest.find('/'), rest.size());
  const std::string_view texture = rest.substr(0, second_slash);
  if (!texture.empty()) {
    const auto count = static_cast<std::int64_t>(texture_coordinates_.size());
    corner.texture = static_cast<std::size_t>(index(texture, count, "texture coordinate"));
  }
  if (second_slash < rest.size()) whole_number(rest.substr(second_slash + 1), "normal");
  return corner;
}

std::vector<Corner> ObjParser::corners(std::size_t at_least) const {
  std::vector<Corner> corners;
  for (std::size_t k = 1; k < words_.size(); ++k) corners.push_back(corner(words_[k]));
  if (corners.size() < at_least)
    fail("at least " + std::to_string(at_least) + (at_least == 1 ? " vertex" : " vertices"),
         std::to_string(corners.size()));
  return corners;
}

void ObjParser::check_face(const std::vector<Corner>& face) const {
  std::vector<VertexId> vertices;
  vertices.reserve(face.size());
  for (const Corner& corner : face) vertices.push_back(corner.vertex);
  std::sort(vertices.begin(), vertices.end());
  const auto twice = std::adjacent_find(vertices.begin(), vertices.end());
  if (twice != vertices.end())
    fail("a face of different vertices", "vertex " + std::to_string(*twice + 1) + " twice");
  const auto n_textures = std::count_if(face.begin(), face.end(),
                                        [](const Corner& c) { return c.texture.has_value(); });
  if (n_textures != 0 && n_textures != static_cast<std::ptrdiff_t>(face.size()))
    fail("texture coordinates at every corner of a face or at none",
         std::to_string(n_textures) + " for " + std::to_string(face.size()) + " corners");
}

/// A triangle of the fan that faces away from the polygon would lie on its neighbours.
void ObjParser::check_fan(const std::vector<Corner>& face) const {
  const Vec3 origin = position(face[0].vertex);
  std::vector<Vec3> doubled_areas;
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 2; k < face.size(); ++k) {
    doubled_areas.push_back(
        (position(face[k - 1].vertex) - origin).cross(position(face[k].vertex) - origin));
    sum += doubled_areas.back();
  }
  // A quad that crosses itself is two triangles that face each other, and their areas cancel.
  constexpr double kCancelled = 0.1;  // share of all areas; two triangles then meet at 11 degrees
  double total = 0;
  for (const Vec3& doubled_area : doubled_areas) total += doubled_area.norm();
  const bool is_cancelled = sum.norm() < kCancelled * total;
  for (const Vec3& doubled_area : doubled_areas)
    if (is_cancelled || doubled_area.dot(sum) < 0)
      fail("a polygon that can be split into triangles about its first corner",
           "one that bends inward or crosses itself");
}

void ObjParser::add_to_groups(const std::vector<Corner>& element) {
  std::vector<std::string> names = group_names_;
  if (!object_.empty()) names.push_back(object_);
  for (const std::string& name : names) {
    const auto [place, is_new] = group_places_.try_emplace(name, mesh_.groups.size());
    if (is_new) mesh_.groups.push_back({name, {}});
    for (const Corner& corner : element)
      mesh_.groups[place->second].vertices.push_back(corner.vertex);
  }
}

void ObjParser::take_vertex() {
  const std::vector<double> values = numbers(3);
  if (n_vertices() == kMaxVertices)
    fail("at most " + std::to_string(kMaxVertices) + " vertices", "one more");
  coordinates_.insert(coordinates_.end(), values.begin(), values.begin() + 3);
  vertex_lines_.push_back(line_);
}

void ObjParser::take_face() {
  const std::vector<Corner> face = corners(3);
  check_face(face);
  check_fan(face);
  add_to_groups(face);
  for (std::size_t k = 2; k < face.size(); ++k) {
    const std::array<Corner, 3> fan{face[0], face[k - 1], face[k]};
    mesh_.triangles.push_back({fan[0].vertex, fan[1].vertex, fan[2].vertex});
    mesh_.lines.push_back(line_);
    std::optional<CornerTexture>& texture = mesh_.textures.emplace_back();
    if (!fan[0].texture) continue;
    texture.emplace();
    for (int c = 0; c < 3; ++c) texture->col(c) = texture_coordinates_[*fan[c].texture];
  }
}

/// An object has one name, which may have blanks; a group statement has any number.
void ObjParser::take_names() {
  std::vector<std::string> names(words_.begin() + 1, words_.end());
  for (std::string& name : names) name = as_utf8(name);
  if (words_[0] == "g") {
    group_names_ = std::move(names);
    return;
  }
  object_.clear();
  for (const std::string& name : names) object_ += (object_.empty() ? "" : " ") + name;
}

void ObjParser::take(std::string_view line, int number) {
  line_ = number;
  if (line.find('\0') != std::string_view::npos) fail("text in UTF-8", "a zero byte");
  words_ = words_of(line);
  if (words_.empty()) return;
  const std::string_view statement = words_[0];
  if (statement == "v") {
    take_vertex();
  } else if (statement == "vt") {
    const std::vector<double> values = numbers(1);
    texture_coordinates_.emplace_back(values[0], values.size() > 1 ? values[1] : 0);
  } else if (statement == "f") {
    take_face();
  } else if (statement == "l" || statement == "p") {
    add_to_groups(corners(statement == "l" ? 2 : 1));
  } else if (statement == "g" || statement == "o") {
    take_names();
  } else if (is_among(kFreeForm, statement)) {
    fail("triangles or polygons (f), as free-form curves and surfaces are none",
         quotation(statement));
  } else if (!is_among(kPassedOver, statement)) {
    ++skipped_[as_utf8(std::string(statement))];
  }
}

ObjMesh ObjParser::finish() {
  if (vertex_lines_.empty()) throw InputError("", "expected vertices (v), got none");
  if (mesh_.triangles.empty()) throw InputError("", "expected faces (f), got none");
  mesh_.positions = Eigen::Map<const Positions>(coordinates_.data(), 3, n_vertices());
  if (const auto fault = mesh_fault(mesh_.positions, mesh_.triangles, 1)) {
    const int line =
        fault->vertex.valid() ? vertex_lines_[fault->vertex] : mesh_.lines[fault->triangle];
    throw InputError("line " + std::to_string(line), fault->sentence);
  }
  for (VertexGroup& group : mesh_.groups) {
    std::vector<VertexId>& vertices = group.vertices;
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  }
  for (const auto& [keyword, count] : skipped_) mesh_.skipped.push_back({keyword, count});
  std::stable_sort(mesh_.skipped.begin(), mesh_.skipped.end(),
                   [](const auto& a, const auto& b) { return a.count > b.count; });
  return std::move(mesh_);
}

/// Numbers every pair of texture coordinates where it first comes up.
class TextureLines {
 public:
  int number(const Eigen::Vector2d& pair) {
    const auto [place, is_new] =
        numbers_.try_emplace({pair.x(), pair.y()}, static_cast<int>(numbers_.size()) + 1);
    if (is_new) text_ += obj_line("vt", {pair.data(), 2});
    return place->second;
  }
  const std::string& text() const { return text_; }

 private:
  std::map<std::pair<double, double>, int> numbers_;
  std::string text_;
};

/// A name with blanks can only be an object's, which ends where the next one begins.
std::string group_lines(const VertexGroup& group) {
  const bool is_object = group.name.find(' ') != std::string::npos;
  std::string text = (is_object ? "g\no " : "g ") + group.name + "\np";
  for (const VertexId v : group.vertices) text += ' ' + std::to_string(v.value + 1);
  return text + (is_object ? "\no\n" : "\n");
}

}  // namespace

std::string obj_line(const char* keyword, std::span<const double> numbers) {
  std::string line = keyword;
  for (const double number : numbers) line += ' ' + Json(number).dump();
  return line + '\n';
}

std::string write_obj(const ObjMesh& mesh) {
  TextureLines textures;
  std::string faces;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    faces += 'f';
    for (std::size_t k = 0; k < 3; ++k) {
      faces += ' ' + std::to_string(mesh.triangles[f][k].value + 1);
      if (const auto& texture = mesh.textures[f])
        faces += '/' + std::to_string(textures.number(texture->col(static_cast<Eigen::Index>(k))));
    }
    faces += '\n';
  }
  std::string text;
  for (Eigen::Index v = 0; v < mesh.positions.cols(); ++v)
    text += obj_line("v", {mesh.positions.col(v).data(), 3});
  text += textures.text() + faces;
  for (const VertexGroup& group : mesh.groups) text += group_lines(group);
  return text;
}

std::string skipped_sentence(std::span<const SkippedStatements> skipped) {
  constexpr std::size_t kMostNamed = 4;
  if (skipped.empty()) return "";
  int total = 0;
  std::string names;
  for (std::size_t k = 0; k < skipped.size(); ++k) {
    total += skipped[k].count;
    if (k >= kMostNamed) continue;
    names +=
        (k == 0 ? "" : "; ") + cut(skipped[k].keyword) + ", " + std::to_string(skipped[k].count);
  }
  if (skipped.size() > kMostNamed) names += "; and others";
  return "skipped " + std::to_string(total) + (total == 1 ? " statement" : " statements") +
         " that Pleat does not use (" + names + ")";
}

ObjMesh read_obj(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark)
    text.remove_prefix(kByteOrderMark.size());
  ObjParser parser;
  for_each_line(text, [&](std::string_view line, int number) { parser.take(line, number); });
  return parser.finish();
}

}  // namespace pleat
