#include "core/files/obj_file.h"
#include "core/scene/start_section.h"

namespace pleat {

// JSON begins with a brace, OBJ never.
StartState read_start_or_obj(const JsonReader& reader, const FileSource& files,
                             const Scene& scene) {
  if (!reader.is_text() || !files) return read_start(reader, files, scene);
  std::optional<StartState> start;
  read_named_file(reader, files, [&](const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos || text[first] != '{')
      start = of_this_cloth("", {read_obj(text).positions, {}, 0}, scene);
    return 0;
  });
  return start ? *std::move(start) : read_start(reader, files, scene);
}

}  // namespace pleat
