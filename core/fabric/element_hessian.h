#pragma once

namespace pleat {

/// Second derivative of an element's energy that a system of equations gets.
enum class ElementHessian {
  exact,      ///< may be indefinite: compressed cloth is unstable sideways
  projected,  ///< positive semidefinite
};

}  // namespace pleat
