#include "core/run/run_ledger.h"

#include <catch2/catch.hpp>

#include "native-tests/support/models.h"

using namespace pleat;

TEST_CASE("run_ledger: it accounts from where it begins, to the last step", "[run]") {
  Simulation simulation(released_sheet_scene(3, "fine cotton"));
  for (int s = 0; s < 5; ++s) REQUIRE(simulation.step().ok());
  const double before = total_energy(simulation.model(), simulation.state());
  RunLedger ledger(simulation);
  CHECK(ledger.account().first_parts().sum() == before);
  for (int s = 0; s < 5; ++s) {
    REQUIRE(simulation.step().ok());
    ledger.record_step();
  }
  const EnergyLedger& account = ledger.account();
  const double after = total_energy(simulation.model(), simulation.state());
  CHECK(account.parts().sum() == after);
  CHECK(account.works().damping < 0);
  CHECK(account.works().sum() + account.drift() == Approx(after - before));
}

TEST_CASE("run_ledger: looking again after no step changes nothing", "[run]") {
  Simulation simulation(released_sheet_scene(3, "fine cotton"));
  REQUIRE(simulation.step().ok());
  RunLedger ledger(simulation);
  REQUIRE(simulation.step().ok());
  ledger.record_step();
  const double damping = ledger.account().works().damping;
  REQUIRE(damping != 0);
  ledger.record_step();
  CHECK(ledger.account().works().damping == damping);
}
