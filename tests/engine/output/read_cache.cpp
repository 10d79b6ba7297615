// The only test file that includes OpenVDB: half a minute to compile.
#include "tests/engine/output/read_cache.h"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

namespace firn::testing {
namespace {

using openvdb::points::AttributeHandle;
using Leaf = openvdb::points::PointDataTree::LeafNodeType;

std::array<float, 3> plain(const openvdb::Vec3f& a) {
  return {a[0], a[1], a[2]};
}

void read_leaf(const Leaf& leaf, const openvdb::math::Transform& transform, ReadCache& out) {
  const AttributeHandle<openvdb::Vec3f> P(leaf.constAttributeArray("P")), v(leaf.constAttributeArray("v"));
  const AttributeHandle<openvdb::Mat3s> F(leaf.constAttributeArray("F_E"));
  const AttributeHandle<std::int64_t> id(leaf.constAttributeArray("id"));
  const AttributeHandle<float> pscale(leaf.constAttributeArray("pscale")), Jp(leaf.constAttributeArray("Jp"));
  const AttributeHandle<std::int32_t> material(leaf.constAttributeArray("material"));
  out.pscale_is_constant = out.pscale_is_constant && leaf.constAttributeArray("pscale").isUniform();
  for (auto point = leaf.beginIndexOn(); point; ++point) {
    const openvdb::Vec3d x =
        transform.indexToWorld(point.getCoord().asVec3d() + openvdb::Vec3d(P.get(*point)));
    const openvdb::Mat3s m = F.get(*point);
    out.id.push_back(id.get(*point));
    out.P.push_back({x[0], x[1], x[2]});
    out.v.push_back(plain(v.get(*point)));
    out.pscale.push_back(pscale.get(*point));
    out.Jp.push_back(Jp.get(*point));
    out.material.push_back(material.get(*point));
    out.F_E.push_back({m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)});
    out.F_E_times_v.push_back(plain(m * v.get(*point)));
  }
}

}  // namespace

ReadCache read_cache(const std::filesystem::path& name) {
  openvdb::initialize();
  openvdb::io::File file(name.string());
  file.open(/*delayed load*/ false);
  ReadCache out;
  const auto metadata = file.getMetadata();
  for (auto it = metadata->beginMeta(); it != metadata->endMeta(); ++it)
    out.metadata[it->first] = it->second->str();
  const auto grid = openvdb::gridPtrCast<openvdb::points::PointDataGrid>(file.readGrid("points"));
  for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf) {
    const auto& descriptor = leaf->attributeSet().descriptor();
    for (const auto& [attribute, position] : descriptor.map())
      out.types[attribute] = descriptor.valueType(position);
    read_leaf(*leaf, grid->transform(), out);
  }
  return out;
}

}  // namespace firn::testing
