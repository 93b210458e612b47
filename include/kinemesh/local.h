// Local untangling: the minimum region around a seed, and nothing beyond it.
#pragma once

#include <memory>
#include <span>

#include "kinemesh/strategy.h"

#pragma GCC visibility push(default)
namespace kinemesh {

// Each seed's minimum locally removable region is explored and re-meshed with upright faces; whatever is
// tangled elsewhere stays as it is [Agarwal 2008, Theorem 4.4, Lemma 3.3]. The piece of the global walk that
// holds the seed takes the region's place, valid but not the minimum, in degenerate positions, for a flat
// seed, and where the labels of a region do not fit together before tangles in its holes are gone.
class LocalUntangling : public Strategy {
 public:
  LocalUntangling();
  ~LocalUntangling() override;
  LocalUntangling(LocalUntangling&&) noexcept;
  LocalUntangling& operator=(LocalUntangling&&) noexcept;

  std::string_view name() const override { return "local"; }

  // All tangles in turn, by the smallest of the user's face numbers, those of padding last.
  [[nodiscard]] RepairOutcome repair(Mesh& mesh, const Move& move) override;

  // Only the regions of these faces (the mesh's numbers), in turn; a seed that has become upright with an
  // earlier region is done. Throws InputError, with nothing changed, for a seed that is upright at the start.
  // The counts of tangles in the record are those of the regions. On a defect nothing is changed.
  [[nodiscard]] RepairOutcome repair_seeds(Mesh& mesh, std::span<const Face> seeds,
                                           const RepairOptions& options);

 private:
  class Worker;
  std::unique_ptr<Worker> worker_;
};

}  // namespace kinemesh
#pragma GCC visibility pop
