#pragma once

#include <string>
#include <vector>

#include "lstm_planner/network/layers.hpp"
#include "lstm_planner/training/sequence.hpp"
#include "lstm_planner/training/trainer.hpp"

namespace lstm_planner {

/// Several accuracies of one epoch, all in [0, 1]. The thesis's accuracy of an epoch jumps by 3-4 % from one epoch to
/// the next (4.2, Fig. 4.10), and is not that of one set of weights; all of these but the first are.
struct EpochAccuracies {
  int epoch = 0;
  double moving = 0.0;               ///< training set, the mean over batches while the weights move (Eq. 4.5)
  double snapshot = 0.0;             ///< training set, all of it by the weights at the epoch's end
  double averaged = 0.0;             ///< training set, by the averaged weights at the epoch's end
  double validation_snapshot = 0.0;  ///< validation set, by the weights at the epoch's end
  double validation_averaged = 0.0;  ///< validation set, by the averaged weights
};

/// Accuracies of the last epoch; `layers` give the shape. Throws std::invalid_argument for a training without
/// averaging.
EpochAccuracies measureEpoch(const LayerStack& layers, const TrainingState& state,
                             const std::vector<Sequence>& training, int threads);

/// How much a curve fluctuates.
struct Fluctuation {
  double deviation = 0.0;       ///< standard deviation around the mean
  double usual_change = 0.0;    ///< root of the mean squared change from one epoch to the next
  double largest_change = 0.0;  ///< from one epoch to the next
  double lowest = 0.0;
  int lowest_epoch = 0;  ///< from 1
};

/// Over the last `epochs` values of a curve with one value for each epoch, or all if there are fewer. All 0 for no
/// value.
Fluctuation fluctuationOf(const std::vector<double>& curve, std::size_t epochs);

/// For people: the fluctuation of each curve over the last 100 epochs, the worst epoch after the first 100, and how
/// much Eq. 4.5 differs from the accuracy of the weights at the epoch's end.
std::string stabilityText(const std::vector<EpochAccuracies>& epochs);

/// Figure 4.10 with all curves, drawn with gnuplot as a PNG picture; a CSV file is written beside it. Throws
/// std::runtime_error if a file cannot be written, or if gnuplot is missing or fails; the CSV file is complete by then.
void writeStability(const std::string& png_path, const std::vector<EpochAccuracies>& epochs);

}  // namespace lstm_planner
