#include "wasm/page_run.h"

#include "core/base/check.h"
#include "core/run/cloth_contact_metrics.h"
#include "wasm/envelope.h"

namespace pleat {

using emscripten::val;

namespace {

constexpr double kUntilCalm = 1;  // time since a hand has let go [s]

}  // namespace

void PageRun::begin() {
  steps_.emplace(*simulation_, TimedRun::Parts::timed);
  watch_.emplace(*simulation_);
  report_ = {};
}

void PageRun::take(std::unique_ptr<Simulation> fresh) {
  const bool was_pulled = simulation_ && !watch_ && fresh->time() > 0;
  if (was_pulled && simulation_->is_grabbed()) calm_ = fresh->time() + kUntilCalm;
  steps_.reset();
  simulation_ = std::move(fresh);
  begin();
  if (was_pulled) watch_.reset();
}

void PageRun::reset() {
  running().reset();
  begin();
}

void PageRun::start_from(const Positions& places) {
  running().start_from(places);
  begin();
}

void PageRun::release_grab() {
  if (!is_loaded() || !running().is_grabbed()) return;
  running().release_grab();
  watch_.reset();
  calm_ = running().time() + kUntilCalm;
}

void PageRun::look() {
  if (running().is_grabbed()) return watch_.reset();
  if (watch_) return watch_->check(running(), report_);
  if (running().time() >= calm_) watch_.emplace(running());
}

Simulation& PageRun::running() const {
  if (!simulation_) throw InputError("", "expected a loaded scene, got none");
  return *simulation_;
}

int PageRun::step(int n, const std::function<void()>& show) {
  try {
    running();
    for (int i = 0; i < n && !report_.ends_run(); ++i) {
      report_ = steps_->step();
      if (!report_.ends_run()) look();
    }
    show();
  } catch (const std::exception& error) {
    report_.status = SolveStatus::not_finite;
    report_.message = error.what();
  }
  return report_.ends_run() ? static_cast<int>(report_.status) : 0;
}

void PageRun::put_status(val& envelope) const {
  envelope.set("status", std::string(name(report_.status)));
  envelope.set("message", report_.message);
}

void PageRun::put_warnings(val& envelope) const {
  running();
  const Json warnings = watch_ ? json_warnings(watch_->warnings()) : Json::array();
  envelope.set("warnings", json_value(warnings.dump()));
}

void PageRun::put_costs(val& envelope) const {
  running();
  val parts = val::object();
  for (int i = 0; i < kPartCount; ++i) {
    const auto part = static_cast<Part>(i);
    const double seconds = steps_->parts().total(part);
    if (seconds > 0) parts.set(std::string(name(part)), 1e3 * seconds);
  }
  envelope.set("parts_ms", parts);
  if (const ClothContact* contact = simulation_->stepper().cloth_contact())
    envelope.set("cloth_contact", json_value(json_cloth_contact(*contact).dump()));
  envelope.set("steps_ms", 1e3 * steps_->seconds());
  envelope.set("steps_timed", static_cast<double>(steps_->n_timed()));
}

}  // namespace pleat
