// What the counts and times say of cases A, B and C: sentences made of nothing but the measurement.
#pragma once

#include <string>
#include <vector>

#include "dissertation/assignment/assignment_measurement.h"

namespace palpate::study {

/// A paragraph each, most important first. The printed threshold must have been measured.
std::vector<std::string> assignmentFindings(const AssignmentMeasurement& found);

/// The row of that tree, case and threshold, which must have been measured.
const AssignmentRow& rowOf(const AssignmentMeasurement& found, hdb::TreeKind tree, hdb::Assignment assignment,
                           Index threshold);

/// The largest of all rows.
double worst(const AssignmentMeasurement& found, double AssignmentRow::*value);

}  // namespace palpate::study
