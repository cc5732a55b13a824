#pragma once

namespace pleat {

/// Which second derivative of an element's energy a system of equations gets.
enum class ElementHessian {
  exact,      ///< may be indefinite: compressed cloth is unstable sideways
  projected,  ///< positive semidefinite
};

}  // namespace pleat
