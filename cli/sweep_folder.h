#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "cli/overwriting.h"
#include "core/sweep/sweep.h"

namespace pleat {

/// Rows as JSON lines.
std::string json_lines(const std::vector<BenchRow>& rows);

/// Says to people what was measured against what, and lists the rows.
std::string sweep_table(const Sweep& sweep);

/// The folder of a sweep that can be stopped at any moment and goes on where it was.
///
/// plan.json says which sweep it is, runs.jsonl is its journal, which grows with every run; from it
/// come rows.jsonl, table.md and front.svg. All members throw FileError.
class SweepFolder {
 public:
  /// Makes the folder for a sweep of this identity, and with --overwrite removes the files of
  /// another. Refuses one that holds another sweep or what is read, and changes nothing then.
  SweepFolder(std::filesystem::path folder, const std::string& identity,
              const Overwriting& overwriting);

  /// The folder of references for which no other one was named.
  std::filesystem::path references() const { return folder_ / "references"; }
  /// The runs of an earlier start.
  std::string journal() const;
  /// Goes on behind the journal's first `n_bytes`.
  void open_journal(std::size_t n_bytes);
  /// A line with its end; it stands in the file when this returns.
  void record(const std::string& line);
  void write_results(const Sweep& sweep) const;

 private:
  std::filesystem::path file(const char* name) const { return folder_ / name; }

  std::filesystem::path folder_;
  std::ofstream journal_;
};

}  // namespace pleat
