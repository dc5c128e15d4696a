// The tables of a campaign, as plain text.
#pragma once

#include <string>
#include <vector>

#include "properties/campaign/fault_hunt.h"
#include "properties/campaign/record.h"
#include "properties/campaign/runner.h"
#include "properties/tetrahedron_world.h"

namespace assay::reports {

// A row for each family and configuration: n, holds, defects, undecided, the bound on the share of
// what does not hold, steps a second and core.
std::string strata_text(const properties::Tally& tally, const properties::CampaignRequest& request);

// Cases by number of triangles and of contacts.
std::string distribution_text(const properties::Tally& tally);

// Set pairs of contacts, then tags.
std::string tags_text(const properties::Counts& counts);

std::string laws_text(const properties::Counts& counts, std::uint64_t wanted_premises);

std::string faults_text(const std::vector<properties::FaultResult>& results);

using WorldResults =
    std::vector<std::pair<const properties::TetrahedronWorld*, properties::TetrahedronWorldResult>>;
std::string worlds_text(const WorldResults& worlds);

std::string shrinking_text(const std::vector<properties::FaultResult>& results);

// The bound of a stratum in one configuration, all of the campaign's bounds together at 95 %.
double bound_of(const properties::StratumTally::Outcomes& outcomes,
                const properties::CampaignRequest& request);

}  // namespace assay::reports
