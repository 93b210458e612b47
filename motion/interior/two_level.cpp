#include "motion/interior/two_level.h"

#include <algorithm>

#include "motion/interior/vertex_blocks.h"

namespace kinemesh {
namespace {

constexpr double little_more =
    1.0 + 1e-10;  // of the diagonal: keeps a matrix that is nearly singular definite

// What the vertex may do of what its block does.
template <class Entry>
class Restrictions {
 public:
  explicit Restrictions(const SlidingVertices& sliding) : sliding_(sliding) {}

  template <class Weight>
  Entry operator()(Vertex row, const Weight& weight, Vertex column) const {
    if constexpr (std::is_same_v<Entry, double>)
      return weight;
    else
      return from_left(row, from_right(Block(weight), column));
  }

 private:
  Block from_left(Vertex v, const Block& entry) const {
    return sliding_.contains(v) ? along(v) * entry : entry;
  }
  Block from_right(const Block& entry, Vertex v) const {
    return sliding_.contains(v) ? entry * along(v) : entry;
  }
  Block along(Vertex v) const { return glm::outerProduct(sliding_.tangent(v), sliding_.tangent(v)); }

  const SlidingVertices& sliding_;
};

int last_vertex(const Fans& fans, int block) {
  return std::min((block + 1) * block_vertices, fans.n_vertices());
}

// Calls visit(v, slot, block of the neighbour) for the block's rows and their neighbours that have rows, in
// blocks up to this one.
template <class Visit>
void for_each_lower_slot(const Fans& fans, int block, const Visit& visit) {
  for (Vertex v(block * block_vertices); v < last_vertex(fans, block); ++v)
    for (int slot = fans.begin(v); slot < fans.end(v); ++slot) {
      const Vertex u = fans.neighbour(slot);
      if (block_of(u) <= block && fans.has_row(u)) visit(v, slot, block_of(u));
    }
}

// The row of a block in the coarse matrix: one entry for each of `neighbours`, the last of which is itself.
template <class Entry, class Weight>
void sum_row(const Fans& fans, const Stiffness<Weight>& stiffness, const SlidingVertices& sliding, int block,
             std::span<const int> neighbours, std::vector<Entry>& row) {
  const Restrictions<Entry> restricted(sliding);
  row.assign(neighbours.size(), Entry(0.0));
  for_each_lower_slot(fans, block, [&](Vertex v, int slot, int other) {
    const auto place = std::lower_bound(neighbours.begin(), neighbours.end(), other) - neighbours.begin();
    row[place] += restricted(v, stiffness.weight(slot), fans.neighbour(slot));
  });
  for (Vertex v(block * block_vertices); v < last_vertex(fans, block); ++v)
    row.back() += restricted(v, stiffness.diagonal(fans, v), v);
}

double or_one(double diagonal) {
  return diagonal > 0.0 ? diagonal * little_more : 1.0;
}

}  // namespace

void CoarseLevel::analyze(const Fans& fans, bool is_coupled) {
  is_coupled_ = is_coupled;
  find_neighbours(fans);
  lay_out();
  columns_.resize(2 * (start_.size() - 1));
  cholesky_.analyze(matrix_);
}

void CoarseLevel::find_neighbours(const Fans& fans) {
  std::array<std::vector<int>, most_parts> found;
  start_.assign(n_blocks(fans.n_vertices()) + 1, 0);
  parallel_blocks(fans.n_vertices(), [&](int part, int begin, int end) {
    std::vector<int> row;
    for (int block = block_of(Vertex(begin)); block * block_vertices < end; ++block) {
      row.assign(1, block);
      for_each_lower_slot(fans, block, [&](Vertex, int, int other) {
        if (other != row.back()) row.push_back(other);
      });
      std::sort(row.begin(), row.end());
      row.erase(std::unique(row.begin(), row.end()), row.end());
      start_[block + 1] = static_cast<int>(row.size());
      found[part].insert(found[part].end(), row.begin(), row.end());
    }
  });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  neighbour_.clear();
  for (const auto& rows : found) neighbour_.insert(neighbour_.end(), rows.begin(), rows.end());
}

void CoarseLevel::lay_out() {
  const int per_block = is_coupled_ ? 2 : 1;
  matrix_.start.assign(1, 0);
  matrix_.column.clear();
  for (std::size_t block = 0; block + 1 < start_.size(); ++block)
    for (int component = 0; component < per_block; ++component) {
      for (int k = start_[block]; k < start_[block + 1]; ++k)
        for (int other = 0; other < per_block; ++other)
          if (k + 1 < start_[block + 1] || other <= component)
            matrix_.column.push_back(per_block * neighbour_[k] + other);
      matrix_.start.push_back(static_cast<int>(matrix_.column.size()));
    }
  matrix_.value.resize(matrix_.column.size());
}

template <class Weight>
void CoarseLevel::factorize(const Fans& fans, const Stiffness<Weight>& stiffness,
                            const SlidingVertices& sliding) {
  const auto fill = [&]<class Entry>(Entry) {
    parallel_blocks(fans.n_vertices(), [&](int, int begin, int end) {
      std::vector<Entry> row;
      for (int block = block_of(Vertex(begin)); block * block_vertices < end; ++block) {
        const std::span neighbours(neighbour_.data() + start_[block], neighbour_.data() + start_[block + 1]);
        sum_row(fans, stiffness, sliding, block, neighbours, row);
        write_row(block, row);
      }
    });
  };
  if constexpr (std::is_same_v<Weight, double>) {
    if (!is_coupled_) fill(double{});
  }
  if (is_coupled_) fill(Block{});
  is_usable_ = cholesky_.factorize(matrix_);
}

void CoarseLevel::write_row(int block, std::span<const double> entries) {
  double* value = std::ranges::copy(entries, matrix_.value.data() + matrix_.start[block]).out;
  value[-1] = or_one(value[-1]);
}

void CoarseLevel::write_row(int block, std::span<const Block> entries) {
  for (int component = 0; component < 2; ++component) {
    double* value = matrix_.value.data() + matrix_.start[2 * block + component];
    for (const Block& entry : entries.first(entries.size() - 1))
      for (int other = 0; other < 2; ++other) *value++ = entry[other][component];
    if (component == 1) *value++ = entries.back()[0][1];
    *value = or_one(entries.back()[component][component]);
  }
}

void CoarseLevel::solve(std::span<Point> blocks) {
  if (!is_usable_) {
    std::ranges::fill(blocks, Point(0.0, 0.0));
    return;
  }
  const std::size_t x = is_coupled_ ? 2 : 1,
                    y = is_coupled_ ? 1 : blocks.size();  // steps to the next block, to y
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    columns_[x * b] = blocks[b].x;
    columns_[x * b + y] = blocks[b].y;
  }
  cholesky_.solve(columns_);
  for (std::size_t b = 0; b < blocks.size(); ++b) blocks[b] = {columns_[x * b], columns_[x * b + y]};
}

template void CoarseLevel::factorize(const Fans&, const Stiffness<double>&, const SlidingVertices&);
template void CoarseLevel::factorize(const Fans&, const Stiffness<Block>&, const SlidingVertices&);

}  // namespace kinemesh
