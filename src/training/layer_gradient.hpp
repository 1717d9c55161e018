#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lstm_planner/network/layers.hpp"

namespace lstm_planner {

/// Where the steps of many sequences lie when they are packed side by side into one matrix:
///
///     step 0          step 1          step 2
///     | a0 b0 c0 d0 | a1 b1 c1 d1 | a2 b2 | ...        sequences a, b longer than c, d
///
/// Longer sequences come first, so that those still running at a step are always the leading columns, nothing is
/// padded, and whatever does not depend on the step before is one product over all columns.
struct StepLayout {
  std::vector<Eigen::Index> first;  ///< first column of a step
  std::vector<Eigen::Index> width;  ///< sequences running at it, never rising
  Eigen::Index columns = 0;         ///< of all steps together

  std::size_t steps() const { return first.size(); }
};

/// Forward and backward pass of one layer over a packed batch. Remembers the forward pass for the backward pass.
template <typename Scalar>
class LayerGradient {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  virtual ~LayerGradient() = default;

  virtual Eigen::Index parameterCount() const = 0;

  /// Reads layout.columns columns of `inputs`. `parameters` points at this layer's part of the parameter vector.
  virtual void forward(const Scalar* parameters, const StepLayout& layout, const Matrix& inputs) = 0;

  /// Of the last forward pass; the first layout.columns columns are meant.
  const Matrix& outputs() const { return outputs_; }

  /// From the error's derivative by the outputs (used as scratch) to those by the parameters (added to `gradient`) and
  /// by the inputs (`input_gradient`, not wanted when null).
  virtual void backward(const Scalar* parameters, const StepLayout& layout, const Matrix& inputs,
                        Matrix& output_gradient, Scalar* gradient, Matrix* input_gradient) = 0;

 protected:
  Matrix outputs_;
};

/// Makes room for `columns` columns; batches differ in size, and memory that only grows is not paged in for each of
/// them.
template <typename Matrix>
void reserveColumns(Eigen::Index rows, Eigen::Index columns, Matrix& matrix) {
  if (matrix.rows() != rows || matrix.cols() < columns) matrix.resize(rows, columns);
}

/// Null for a SoftmaxLayer, which belongs to the loss.
template <typename Scalar>
std::unique_ptr<LayerGradient<Scalar>> makeLayerGradient(const Layer& layer);

extern template std::unique_ptr<LayerGradient<float>> makeLayerGradient<float>(const Layer&);
extern template std::unique_ptr<LayerGradient<double>> makeLayerGradient<double>(const Layer&);

}  // namespace lstm_planner
