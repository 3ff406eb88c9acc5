//! Attitudes in 64 bits.

use sbgc_proto_macros::record;

use crate::wire::Bytes;

/// Unit quaternion in 64 bits: the largest component is omitted, because it follows from the others.
///
/// The other three components have 20 bits each, starting at bit 0: 19 for the magnitude and one for the sign. Bits 60
/// and 61 encode which component is omitted, and bit 62 is its sign. Real-time data and quaternion control use the same
/// packing, which newer specifications describe in an appendix.
///
/// The layout follows comments in one of the vendor's libraries. The order of components, w, x, y, z, is inferred from
/// quaternions that are not packed. No other source publishes either, so verify it with a known attitude before relying
/// on it.
///
/// ```
/// use sbgc_proto::units::PackedQuaternion;
///
/// let [w, x, y, z] = PackedQuaternion::pack([0.8, 0.0, 0.0, -0.6]).unpack();
/// assert!((w - 0.8).abs() < 1e-5 && x == 0.0 && y == 0.0 && (z + 0.6).abs() < 1e-5);
/// ```
///
/// Spec: `QUAT_PACKED`.
#[record]
#[derive(Copy)]
pub struct PackedQuaternion(pub Bytes<8>);

impl PackedQuaternion {
    /// Steps of a component: the maximum of those that are kept is the square root of 1/2.
    const STEPS: f32 = 741_453.8;

    /// Unpacks the quaternion w, x, y, z.
    #[allow(clippy::cast_precision_loss, reason = "a float holds the 19 bits of a component")]
    pub fn unpack(self) -> [f32; 4] {
        let bits = u64::from_le_bytes(self.0.0);
        let signed = |value: f32, negative: u64| if negative == 0 { value } else { -value };
        let mut squares = 0.0;
        let mut kept = [0, 20, 40].into_iter().map(|shift| {
            let value = (bits >> shift & 0x7_FFFF) as f32 / Self::STEPS;
            squares += value * value;
            signed(value, bits >> shift & 0x8_0000)
        });
        let largest = bits >> 60 & 3;
        let quaternion = [0, 1, 2, 3].map(|index| if index == largest { None } else { kept.next() });
        let left_out = signed(square_root(1.0 - squares), bits >> 62 & 1);
        quaternion.map(|component| component.unwrap_or(left_out))
    }

    /// Packs a unit quaternion w, x, y, z.
    #[must_use]
    pub fn pack(quaternion: [f32; 4]) -> Self {
        let mut largest = (0, 0.0_f32);
        for (index, component) in (0_u64..).zip(quaternion) {
            if component.abs() > largest.1.abs() {
                largest = (index, component);
            }
        }
        let mut bits = largest.0 << 60 | u64::from(largest.1 < 0.0) << 62;
        let mut shift = 0;
        for (index, component) in (0_u64..).zip(quaternion) {
            if index != largest.0 {
                let steps = component.abs() * Self::STEPS + 0.5;
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "the cast rounds, and saturates what is not of length 1"
                )]
                let magnitude = u64::from((steps as u32).min(0x7_FFFF));
                bits |= (magnitude | u64::from(component < 0.0) << 19) << shift;
                shift += 20;
            }
        }
        Self(Bytes(bits.to_le_bytes()))
    }
}

/// The square root of a number from 1/4 to 1, which is what is left for the largest of four components; 0 for less than
/// nothing.
fn square_root(square: f32) -> f32 {
    if square <= 0.0 {
        return 0.0;
    }
    // Newton's method doubles the digits each time.
    (0..5).fold(1.0, |root, _| (root + square / root) * 0.5)
}
