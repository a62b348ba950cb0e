#pragma once
/// Pina 2009 as a part of the program: a process of its own that draws, and what the report says of it.
///   const PaperPart paper = measure_paper(options, arguments);
///   draw_all(out, paper::paper_plots(paper.run)); ... paper_section(paper, plots) ...
#include "apps/culling_benchmark/options.h"
#include "apps/culling_benchmark/paper_rows.h"

namespace manzana::culling_benchmark {

/// Empty: not asked for.
struct PaperPart {
  paper::PaperRun run;
  std::vector<paper::PaperRow> rows;
  std::string why_not;  ///< nothing could be drawn
};

/// Starts the process that draws, reads its record, OUT/paper_frames.csv, and writes OUT/paper.csv. What is in the
/// record already is not measured again. `arguments`: of this program. Throws Interrupted, and std::runtime_error when
/// a file cannot be written.
PaperPart measure_paper(const Options& options, const std::vector<std::string>& arguments);

/// The other end: measures, keeps the record and tells its progress on stdout.
void run_paper_process(const Options& options);

/// Of report.md. `plots`: names of those that were drawn.
std::string paper_section(const PaperPart& part, std::span<const std::string> plots);

/// What the columns of paper.csv and paper_frames.csv are, in Markdown.
std::string paper_columns_md();

}  // namespace manzana::culling_benchmark
