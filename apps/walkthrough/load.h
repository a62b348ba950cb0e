#pragma once
/// From the options to what is drawn: the city and its plants, and what is said about them.
#include <string>
#include <vector>

#include "apps/walkthrough/options.h"
#include "scenegraph/import/import.h"

namespace manzana::walkthrough {

/// With a progress bar on stderr. Throws as import_city does.
Imported load_city(const Options& options);

/// One model for each PlantSpecies: the files of --plant, then, for the others, our own; kept prepared from one start
/// to the next. With a progress bar on stderr. Throws as load_plant does.
using Plants = std::vector<foliage::PreparedPlant>;
Plants load_named_plants(const Options& options);
void load_other_plants(const Options& options, Plants& plants);

/// Blocks, objects a block, how many fell back; one line.
std::string report_line(const Imported& city);

/// The count and the first few, a line each; empty without issues.
std::string issue_lines(const std::vector<Issue>& issues, std::size_t most = 5);
/// issues.txt: all of them, where<TAB>what.
std::string issue_table(const std::vector<Issue>& issues);

}  // namespace manzana::walkthrough
