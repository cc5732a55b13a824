#include "core/files/obj_file.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/base/random.h"
#include "core/files/frame_file.h"
#include "core/scene/scene.h"
#include "native-tests/support/meshes.h"

namespace pleat {
namespace {

// Two triangles over a square.
const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

struct BadObj {
  std::string text;
  std::string where;
  std::string sentence;
};

const BadObj kBadTexts[] = {
    // Numbers.
    {"v 0 0 x\n", "line 1", R"(expected a number, got "x")"},
    {"v 0 0 1.2.3\n", "line 1", R"(expected a number, got "1.2.3")"},
    {"v 0 0 0x10\n", "line 1", R"(expected a number, got "0x10")"},
    {"v 0 0\n", "line 1", "expected at least 3 numbers, got 2"},
    {"v\n", "line 1", "expected at least 3 numbers, got 0"},
    {"v 0 nan 0\n", "line 1", R"(expected a number, got "nan")"},
    {"v 0 -inf 0\n", "line 1", R"(expected a number, got "-inf")"},
    {"v 0 2e12 0\n", "line 1", R"(expected a number of at most 1e12 in size, got "2e12")"},
    {"v 0 1e999 0\n", "line 1", R"(expected a number of at most 1e12 in size, got "1e999")"},
    {"v 0 0 0 red\n", "line 1", R"(expected a number, got "red")"},
    {"vt\n", "line 1", "expected at least 1 number, got 0"},
    // Faces.
    {kSquare + "f 0 1 2\n", "line 5",
     R"(expected the number of a vertex, 1 to 4 or as many back from -1, as so many stand above, got "0")"},
    {kSquare + "f 1 2 5\n", "line 5",
     R"(expected the number of a vertex, 1 to 4 or as many back from -1, as so many stand above, got "5")"},
    {kSquare + "f 1 2 -5\n", "line 5",
     R"(expected the number of a vertex, 1 to 4 or as many back from -1, as so many stand above, got "-5")"},
    {kSquare + "f 1 2 99999999999999999999\n", "line 5",
     R"(expected the number of a vertex, got "99999999999999999999")"},
    {kSquare + "f 1 2 2.5\n", "line 5", R"(expected the number of a vertex, got "2.5")"},
    {kSquare + "f 1 2 /3\n", "line 5", R"(expected the number of a vertex, got "")"},
    {kSquare + "f 1 2\n", "line 5", "expected at least 3 vertices, got 2"},
    {kSquare + "f 1 2 3 -2\n", "line 5",
     "expected a face of different vertices, got vertex 3 twice"},
    {kSquare + "vt 0 0\nf 1/1 2/2 3/1\n", "line 6",
     R"(expected the number of a texture coordinate, 1 to 1 or as many back from -1, as so many stand above, got "2")"},
    {kSquare + "vt 0 0\nf 1/1 2 3/1\n", "line 6",
     "expected texture coordinates at every corner of a face or at none, got 2 for 3 corners"},
    {kSquare + "f 1//1 2//x 3//1\n", "line 5", R"(expected the number of a normal, got "x")"},
    {kSquare + "vt 0 0\nf 1/1/1/1 2/1 3/1\n", "line 6",
     R"(expected the number of a normal, got "1/1")"},
    {"v 0 0 0\nv 2 0 0\nv 0.5 0.5 0\nv 0 2 0\nf 2 3 4 1\n", "line 5",
     "expected a polygon that can be split into triangles about its first corner, got one that "
     "bends inward or crosses itself"},
    {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3 4\n", "line 5",
     "expected a polygon that can be split into triangles about its first corner, got one that "
     "bends inward or crosses itself"},
    {kSquare + "l 1\n", "line 5", "expected at least 2 vertices, got 1"},
    {kSquare + "p\n", "line 5", "expected at least 1 vertex, got 0"},
    // Statements.
    {"w 1 2 3\n", "", "expected vertices (v), got none"},
    {"\n{\"cloth\": 1}\n", "", "expected vertices (v), got none"},
    {"cstype bspline\n", "line 1",
     "expected triangles or polygons (f), as free-form curves and surfaces are none, got "
     "\"cstype\""},
    {kSquare + "curv2 1 2\n", "line 5",
     "expected triangles or polygons (f), as free-form curves and surfaces are none, got "
     "\"curv2\""},
    {std::string("v 0 0 0\nv 1 \0 0\n", 16), "line 2", "expected text in UTF-8, got a zero byte"},
    {"\x7f"
     "ELF\x02\x01",
     "", "expected vertices (v), got none"},
    // The whole.
    {"", "", "expected vertices (v), got none"},
    {"# only\n", "", "expected vertices (v), got none"},
    {kSquare, "", "expected faces (f), got none"},
    {kSquare + "\nf 1 2 3\n", "line 4",
     "expected every vertex in a triangle, got vertex 4 in none"},
    {kSquare + "v 2 2 0\nf 1 3 2\nf 1 3 5\n", "line 7",
     "expected a triangle with an area, got the vertices 1, 3 and 5 on a line"},
    {kSquare + "v 2 2 1e-7\nf 1 2 3\nf 1 3 5\n", "line 7",
     "expected a triangle with an area, got the vertices 1, 3 and 5 on a line"},
    {kSquare + "v 0 0 1\nf 1 2 3\nf 3 4 1\n\nf 1 3 5\n", "line 9",
     "expected at most two triangles at an edge, got a third at that from vertex 1 to 3"},
    {kSquare + "f 1 2 3\nf 3 2 1\n", "line 6",
     "expected each triangle once, got two with the vertices 2, 1 and 3"},
    {kSquare + "f 1 2 3\nf 1 4 3\n", "line 6",
     "expected neighbours wound alike, got two triangles that both go from vertex 3 to 1"},
    {kSquare + "f 1 2 3 \\\n 4\nf 1 x 2\n", "line 7",
     R"(expected the number of a vertex, got "x")"},
};

/// One triangle per vertex triple of the numbers in the text, counted from 0.
std::vector<std::array<int, 3>> corners(const ObjMesh& mesh) {
  std::vector<std::array<int, 3>> numbers;
  for (const auto& [a, b, c] : mesh.triangles) numbers.push_back({a, b, c});
  return numbers;
}

std::vector<int> numbers(const VertexGroup& group) {
  return {group.vertices.begin(), group.vertices.end()};
}

using Triples = std::vector<std::array<int, 3>>;

}  // namespace

TEST_CASE("obj: a bad text is refused with its line, what was expected and what was found",
          "[files]") {
  for (const BadObj& bad : kBadTexts) {
    CAPTURE(bad.text);
    try {
      read_obj(bad.text);
      FAIL_CHECK("was accepted");
    } catch (const InputError& error) {
      CHECK(error.where() == bad.where);
      CHECK(error.sentence() == bad.sentence);
    }
  }
}

TEST_CASE("obj: statements of other programs are skipped and counted", "[files]") {
  const std::string triangles = kSquare + "f 1 2 3\nf 1 3 4\n";
  CHECK(read_obj(triangles + "vn 0 0 1\nusemtl wool\n").skipped.empty());
  const ObjMesh mesh = read_obj("seam 1 2\nfoo\n" + triangles + "seam 3 4\n");
  REQUIRE(mesh.skipped.size() == 2);
  CHECK(mesh.skipped[0].keyword == "seam");
  CHECK(mesh.skipped[0].count == 2);
  CHECK(skipped_sentence(mesh.skipped) ==
        "skipped 3 statements that Pleat does not use (seam, 2; foo, 1)");
  CHECK(skipped_sentence({}).empty());
  CHECK(skipped_sentence(read_obj("a\nb\nc\nd\ne\nb\n" + triangles).skipped) ==
        "skipped 6 statements that Pleat does not use (b, 2; a, 1; c, 1; d, 1; and others)");
}

TEST_CASE("obj: one vertex more than a simulation takes is refused at its line", "[files]") {
  std::string text;
  for (std::int64_t i = 0; i <= kMaxVertices; ++i) text += "v 0 0 0\n";
  try {
    read_obj(text);
    FAIL("was accepted");
  } catch (const InputError& error) {
    CHECK(error.where() == "line 1000001");
    CHECK(error.sentence() == "expected at most 1000000 vertices, got one more");
  }
}

TEST_CASE("obj: what simulations have no use for is passed over", "[files]") {
  const ObjMesh mesh = read_obj(
      "\xef\xbb\xbf# from elsewhere, in C:\\garments\\\n"
      "v 0 0 0 1.0\nmtllib a.mtl\nv 1 0 0 0.5 0.5 0.5 # grey\nv\t1 1  0 \nvn 0 0 1\nvp 0.1\nusemtl "
      "red\ns off\n"
      "f 1//1 2//1 3//1");
  CHECK(mesh.positions.col(2) == Vec3(1, 1, 0));
  CHECK(corners(mesh) == Triples{{0, 1, 2}});
  CHECK_FALSE(mesh.textures.at(0));
  CHECK(mesh.groups.empty());
}

TEST_CASE("obj: every way to end and to continue a line gives the same mesh", "[files]") {
  const std::string unix = kSquare + "f 1 2 \\\n3\nf 1 3 \\\n\\\n 4\n";
  const std::string end = GENERATE("\n", "\r\n", "\r");
  std::string text;
  for (const char c : unix) text += c == '\n' ? end : std::string(1, c);
  const ObjMesh mesh = read_obj(text);
  CHECK(mesh.positions.cols() == 4);
  CHECK(corners(mesh) == Triples{{0, 1, 2}, {0, 2, 3}});
  CHECK(mesh.lines == std::vector<int>{5, 7});
}

TEST_CASE("obj: a polygon becomes the fan about its first corner", "[files]") {
  const ObjMesh mesh = read_obj("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 5 1 2 3 4\n");
  CHECK(corners(mesh) == Triples{{4, 0, 1}, {4, 1, 2}, {4, 2, 3}});
  CHECK(mesh.lines == std::vector<int>{6, 6, 6});
}

TEST_CASE("obj: negative numbers count back from where they stand", "[files]") {
  const ObjMesh mesh = read_obj(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf -3/-3 -2/-2 -1/-1\n"
      "v 1 1 0\nvt 1 1\nf -2/-2 2/2 -1/-1\n");
  CHECK(corners(mesh) == Triples{{0, 1, 2}, {2, 1, 3}});
  CHECK(mesh.textures.at(1)->col(2) == Eigen::Vector2d(1, 1));
  CHECK(mesh.textures.at(1)->col(0) == Eigen::Vector2d(0, 1));
}

TEST_CASE("obj: texture coordinates belong to corners, and one number is enough", "[files]") {
  const ObjMesh mesh =
      read_obj(kSquare + "vt 0.25\nvt 1 2 3\nvt -1 5\nf 1/1 2/2 3/3\nf 1/2/9 3/1/9 4/3/9\n");
  REQUIRE(mesh.textures.size() == 2);
  CHECK(mesh.textures[0]->col(0) == Eigen::Vector2d(0.25, 0));
  CHECK(mesh.textures[0]->col(1) == Eigen::Vector2d(1, 2));
  CHECK(mesh.textures[1]->col(0) == Eigen::Vector2d(1, 2));
  CHECK(mesh.textures[1]->col(2) == Eigen::Vector2d(-1, 5));
}

TEST_CASE("obj: groups and objects hold the vertices of all their elements, once", "[files]") {
  const ObjMesh mesh = read_obj(kSquare +
                                "o the skirt\ng front waist\nf 3 1 2\ng\nf 1 3 4\ng waist\nl 4 1\n"
                                "g unused\ng hem\np 4\no other\np 2 2\n");
  REQUIRE(mesh.groups.size() == 5);
  CHECK(mesh.groups[0].name == "front");
  CHECK(numbers(mesh.groups[0]) == std::vector<int>{0, 1, 2});
  CHECK(mesh.groups[1].name == "waist");
  CHECK(numbers(mesh.groups[1]) == std::vector<int>{0, 1, 2, 3});
  CHECK(mesh.groups[2].name == "the skirt");
  CHECK(numbers(mesh.groups[2]) == std::vector<int>{0, 1, 2, 3});
  CHECK(mesh.groups[3].name == "hem");
  CHECK(numbers(mesh.groups[3]) == std::vector<int>{1, 3});
  CHECK(mesh.groups[4].name == "other");
  CHECK(numbers(mesh.groups[4]) == std::vector<int>{1});
}

TEST_CASE("obj: bytes of a name that are no UTF-8 are replaced", "[files]") {
  const ObjMesh mesh = read_obj(kSquare +
                                "g R\xf6"
                                "ckchen\nf 1 2 3 4\n");
  CHECK(mesh.groups.at(0).name ==
        "R\xef\xbf\xbd"
        "ckchen");
}

TEST_CASE("obj: a mesh that was written reads back to the bit", "[files]") {
  const QuadMesh sheet = square_sheet(5);
  Random random(3);
  const Positions x = shaken(sheet.rest_positions(), 0.03, random);
  const bool with_texture = GENERATE(true, false);
  FrameMesh frame{{}, sheet.triangles()};
  if (with_texture) frame.rest_coordinates = sheet.rest_coordinates();
  const ObjMesh mesh = read_obj(obj_text(frame, x));
  CHECK(mesh.positions == x);
  CHECK(mesh.triangles == frame.triangles);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    REQUIRE(mesh.textures[f].has_value() == with_texture);
    if (with_texture)
      CHECK(mesh.textures[f]->col(1) == sheet.rest_coordinates().col(mesh.triangles[f][1]));
  }
}

TEST_CASE("obj: a seam's two textures, no texture and groups of any name read back", "[files]") {
  const ObjMesh mesh = read_obj(
      "v 0 0 0\nv 0.1 0 0\nv 0 0.3 0\nv 1 1 1e-7\nvt 0 0\nvt 1 0\nvt 0 1\nvt 5 0.7\nvt 6 0\n"
      "o the shirt\nf 1/1 2/2 3/3\ng front sleeve\nf 2/4 4/5 3/1\no\ng hem\nl 1 2\n");
  ObjMesh plain = mesh;
  plain.textures[0].reset();
  for (const ObjMesh& given : {mesh, plain}) {
    const ObjMesh again = read_obj(write_obj(given));
    CHECK(again.positions == given.positions);
    CHECK(again.triangles == given.triangles);
    CHECK(again.textures == given.textures);
    REQUIRE(again.groups.size() == 4);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(again.groups[k].name == given.groups[k].name);
      CHECK(again.groups[k].vertices == given.groups[k].vertices);
    }
  }
}

}  // namespace pleat
