#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/arguments.h"
#include "cli/source.h"
#include "core/deform/deform_solver.h"
#include "core/files/json_text.h"
#include "core/scene/deform/deform_scene.h"

namespace pleat {

constexpr const char* kDeformHelp =
    R"(  --pin PLACE            hold what is there; --handle PLACE:X,Y,Z  move it so far [m]. Each may come
                         several times, beside the scene's own. A place is vertex numbers from 0
                         (3 or 3,4), a group's name, box:X,Y,Z,X,Y,Z (two corners) or near:X,Y,Z
                         (a twentieth of the cloth's longest side around it) or near:X,Y,Z,R;
                         a handle's place may be the name of the scene's, which then goes there
  --fabric NAME          of the library; --measure R,S,B  own measurements of recovery, stretch and
                         bending; --weights R,S,B  the three terms' weights themselves
  --fabrics FILE         read the fabrics from here
  --form published       sums over vertices and edges; consistent (default): integrals over cloth
  --terms A,B            leave out those of recovery, stretch and bending that are not named
)";

/// A deformation and where its values came from.
struct DeformInput : Source {
  DeformScene scene;
  FabricLibrary fabrics;
  std::vector<std::filesystem::path> files_read;  ///< its file, and those that it names

  std::string need() const { return "for its cloth"; }
};

/// Moves what the scene holds to its place, and takes no step yet.
DeformSolver held_solver(const DeformScene& scene);

/// Weights, measures or terms.
template <class Three>
Json json_three(const Three& numbers) {
  return {
      {"recovery", numbers.recovery}, {"stretch", numbers.stretch}, {"bending", numbers.bending}};
}

/// Reads the scene or mesh that the last word names, with the options --fabrics, --fabric,
/// --measure,
/// --weights, --form, --terms, --pin and --handle.
DeformInput take_deform_scene(Arguments& arguments);

}  // namespace pleat
