#include "cli/command_table.h"

namespace pleat {

extern const Command kBenchRun, kBenchReference, kBenchDeform, kBenchInbetween, kBenchPlans,
    kBenchTogether, kBenchRestarts, kBenchResponse, kBenchRows, kBenchLimit, kBenchDepth;

namespace {

constexpr const Command* kParts[] = {&kBenchRun,       &kBenchReference, &kBenchDeform,
                                     &kBenchInbetween, &kBenchPlans,     &kBenchTogether,
                                     &kBenchRestarts,  &kBenchResponse,  &kBenchRows,
                                     &kBenchLimit,     &kBenchDepth};

Outcome bench_command(Arguments arguments) {
  const Command& part = take_command(kParts, arguments, "bench");
  arguments.flag("--json");  // its only form
  return part.run(std::move(arguments));
}

}  // namespace

extern const Command kBenchCommand(
    "bench", "PART ...", "what runs cost and how right they are, for programs, in JSON",
    bench_command, {}, "pleat bench PART --help, or pleat help bench PART: its options\n", kParts);

}  // namespace pleat
