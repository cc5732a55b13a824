#include "cli/sweep_folder.h"

#include <array>
#include <set>

#include "core/base/formatted.h"
#include "core/files/whole_file.h"
#include "core/sweep/front_chart.h"

namespace pleat {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlan = "plan.json";
constexpr const char* kJournal = "runs.jsonl";
constexpr const char* kRows = "rows.jsonl";
constexpr const char* kTable = "table.md";
constexpr const char* kChart = "front.svg";
/// The plan's last: without the others it is a sweep that has just begun.
constexpr std::array kFiles = {kJournal, kRows, kTable, kChart, kPlan};

Json core_of(const std::string& identity) {
  const Json json = Json::parse(identity, nullptr, /*allow_exceptions=*/false);
  return json.is_object() ? json.value("core", Json()) : Json();
}

}  // namespace

std::string json_lines(const std::vector<BenchRow>& rows) {
  std::string lines;
  for (const BenchRow& row : rows) lines += json_bench_row(row).dump() + "\n";
  return lines;
}

std::string sweep_table(const Sweep& sweep) {
  std::string text =
      printable(sweep.plan().name) + formatted(", %.4g s; errors against", sweep.plan().duration);
  std::set<std::string> known;
  for (const BenchRow& row : sweep.rows()) {
    const ReferenceLabel& reference = row.reference;
    if (!known.insert(reference.id).second) continue;
    text += (known.size() == 1 ? " " : ",\n") + reference.id + ": " +
            printable(reference.description) +
            (reference.converged ? " (converged)" : " (not converged)");
  }
  return text + "\n\n" + markdown_table(sweep.rows());
}

SweepFolder::SweepFolder(fs::path folder, const std::string& identity,
                         const Overwriting& overwriting)
    : folder_(std::move(folder)) {
  std::error_code error;
  const auto is_there = [&](const char* name) { return fs::exists(file(name), error); };
  const std::string known = is_there(kPlan) ? read_file(file(kPlan)) : "";
  const bool is_same = known == identity;
  for (const char* name : kFiles) {
    if (is_same || overwriting.is_asked() || !is_there(name)) continue;
    const bool is_other_core = !known.empty() && core_of(known) != core_of(identity);
    throw FileError(folder_, std::string("expected a folder without another sweep's files, got ") +
                                 name + " of another " + (is_other_core ? "core" : "plan") +
                                 "; --overwrite removes them");
  }
  make_folder(folder_);
  for (const char* name : kFiles) {
    check_writable(file(name));
    overwriting.check_spared(file(name));
  }
  if (is_same && !overwriting.is_asked()) return;
  for (const char* name : kFiles)
    if (is_there(name)) remove_file(file(name));
  write_file(file(kPlan), identity);
}

std::string SweepFolder::journal() const {
  std::error_code error;
  return fs::exists(file(kJournal), error) ? read_file(file(kJournal)) : "";
}

void SweepFolder::open_journal(std::size_t n_bytes) {
  write_file(file(kJournal), journal().substr(0, n_bytes));
  journal_.open(file(kJournal), std::ios::binary | std::ios::app);
}

void SweepFolder::record(const std::string& line) {
  journal_ << line << std::flush;
  if (!journal_) throw LostOutput(file(kJournal), "at its last line");
}

void SweepFolder::write_results(const Sweep& sweep) const {
  write_file(file(kRows), json_lines(sweep.rows()));
  write_file(file(kTable), sweep_table(sweep));
  write_file(file(kChart), front_chart(sweep.rows()));
}

}  // namespace pleat
