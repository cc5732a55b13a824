#include "core/hard_cases/hard_case_table.h"

#include <iterator>

#include "core/hard_cases/position_based_exceptions.h"

namespace pleat {

std::vector<HardCase> hard_cases() {
  std::vector<HardCase> all;
  for (const auto part :
       {element_cases, holding_cases, contact_cases, lasting_cases, likeness_cases, still_cases}) {
    std::vector<HardCase> cases = part();
    std::move(cases.begin(), cases.end(), std::back_inserter(all));
  }
  except_position_based(all);
  return all;
}

}  // namespace pleat
