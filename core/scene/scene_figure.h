#pragma once

#include "core/files/file_source.h"
#include "core/files/json_reader.h"
#include "core/scene/scene.h"

namespace pleat {

/// The section "figure" of a scene file: a body, and a motion written out or the name of its file.
Figure read_figure(const JsonReader& reader, const FileSource& files);

/// The motion is always written out, so that the text is the whole scene.
Json json_figure(const Figure& figure);

}  // namespace pleat
