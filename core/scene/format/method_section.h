#pragma once

#include "core/dynamics/stepper_table.h"
#include "core/files/json_reader.h"
#include "core/scene/scene.h"

namespace pleat {

/// The section "method" of a scene file: a stepper of the table, its step and the settings that it
/// reads. Throws InputError for a setting that it does not read.
MethodOptions read_method(const JsonReader& reader, StepperTable steppers);
/// Contains every setting that the stepper reads.
Json json_method(const MethodOptions& method);

/// The rows of the table as JSON: all that a page needs to know of each stepper.
Json json_steppers(StepperTable steppers);
/// Settings that people may choose for a method beside its counts, in the order in which a page
/// shows them: words or bounds, titles, meanings. A row of json_steppers has the values that its
/// stepper starts from.
Json json_method_details(StepperTable steppers = standard_steppers());

/// The section "record": which frames are kept, and how.
void read_record(const JsonReader& reader, RecordOptions& record);
Json json_record(const RecordOptions& record);

}  // namespace pleat
