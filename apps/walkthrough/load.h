#pragma once
/// From the options to what is drawn: the city and its plants, and what is said about them.
#include <string>
#include <vector>

#include "apps/walkthrough/options.h"
#include "scenegraph/import/import.h"

namespace manzana::walkthrough {

/// By TreeInstance::plant; kept prepared from one start to the next. All that load does it with a progress bar on
/// stderr.
using Plants = std::vector<foliage::PreparedPlant>;

/// The files of --plant, the other species empty. Throws as load_plant does.
Plants load_named_plants(const Options& options);

/// The cities and lists of trees, as one; or an ecosystem (.json), whose plants are added. Throws as import_city,
/// read_tree_list, read_ecosystem and read_ground_photo do. The ground has its photo then, if one is named.
Imported load_city(const Options& options, Plants& plants);

/// Our own models of the species that stand there and have none yet.
void load_other_plants(const Options& options, const Scene& scene, Plants& plants);

/// Blocks, objects a block, how many fell back; one line.
std::string report_line(const Imported& city);

/// The count and the first few, a line each; empty without issues.
std::string issue_lines(const std::vector<Issue>& issues, std::size_t most = 5);
/// issues.txt: all of them, where<TAB>what.
std::string issue_table(const std::vector<Issue>& issues);

}  // namespace manzana::walkthrough
