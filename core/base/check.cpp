#include "core/base/check.h"

namespace pleat {

void throw_contract_error(const char* condition, const char* file, int line, const char* sentence) {
  throw ContractError(std::string(file) + ":" + std::to_string(line) + ": " + sentence + " (" +
                      condition + ")");
}

}  // namespace pleat
