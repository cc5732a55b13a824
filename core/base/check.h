// Three kinds of failure have three channels: our bug (ContractError), their input (InputError),
// and the numbers (a returned SolveReport, linalg/solve_report.h).
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace pleat {

/// A broken promise inside the program; the text names the condition and its place.
class ContractError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Bad input from outside. `where` is a JSON pointer, a file with line, an option's name, or empty
/// for the input as a whole; `sentence` says what was expected and what was found; what() both,
/// "/cloth/rows: expected at least 1, got 0".
class InputError : public std::runtime_error {
 public:
  InputError(std::string where, std::string sentence)
      : std::runtime_error(where.empty() ? sentence : where + ": " + sentence),
        where_(std::move(where)),
        sentence_(std::move(sentence)) {}
  const std::string& where() const { return where_; }
  const std::string& sentence() const { return sentence_; }

 private:
  std::string where_, sentence_;
};

[[noreturn]] void throw_contract_error(const char* condition, const char* file, int line,
                                       const char* sentence);

}  // namespace pleat

/// Checked in every build, at the entry of a module.
#define PLEAT_CHECK(condition, sentence)                                                       \
  do {                                                                                         \
    if (!(condition)) ::pleat::throw_contract_error(#condition, __FILE__, __LINE__, sentence); \
  } while (false)
