#include <kinemesh.h>
#include <kinemesh/kinemesh.h>
#include <kinemesh/plugin.h>

#include <type_traits>

using namespace kinemesh;

// What is of one kind is not taken for another.
static_assert(!std::is_convertible_v<Vertex, Face> && !std::is_convertible_v<int, Side>);
static_assert(!std::is_constructible_v<Vertex, UserVertex>);
static_assert(sizeof(Vertex) == sizeof(int) && std::is_trivially_copyable_v<Vertex>);

// Macros of the libraries inside would show.
#if defined(CGAL_VERSION) || defined(BOOST_VERSION) || defined(TBB_VERSION_MAJOR) || defined(FMT_VERSION)
#error "a public header includes what it should not"
#endif
