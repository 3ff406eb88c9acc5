//! What declarations of every shape do, on small messages made for it.

use sbgc_proto_macros::{message, record};

use super::{Element, List, Packed, PerAxis, Reserved, Text};
use crate::units::Angle;
use crate::{DecodeError, EncodeError, Message};

/// Optional tails.
#[message(CMD_CALIB_ACC, outgoing, size = 1..=6)]
pub(super) struct Tails {
    /// Always there.
    pub first: u8,
    /// From the second byte on.
    pub second: Option<u16>,
    /// To the end.
    #[wire(since = "2.70")]
    pub third: Option<[u8; 3]>,
}

/// Conditions on earlier fields.
#[message(CMD_CALIB_GYRO, outgoing, size = 1..=7)]
pub(super) struct Conditions {
    /// What follows.
    pub flags: u8,
    /// With bit 0.
    #[wire(when = *flags & 1 != 0)]
    pub low: Option<PerAxis<u8>>,
    /// With bit 1.
    #[wire(when = *flags & 2 != 0, context = *flags)]
    pub nested: Option<Nested>,
}

/// Knows what stands before it.
#[record(context(outer: u8))]
pub(super) struct Nested {
    /// With bit 7 of the outer flags.
    #[wire(when = outer & 0x80 != 0)]
    pub wide: Option<u16>,
    /// Always.
    pub narrow: u8,
}

/// Lists of all kinds.
#[message(CMD_CALIB_MAG, incoming, size = 2..=255)]
pub(super) struct Lists<'a> {
    /// With a count byte.
    #[wire(counted_by = "NUM")]
    pub counted: List<Angle, 4>,
    /// As many as it says.
    pub most: u8,
    /// At most that.
    #[wire(at_most = usize::from(*most))]
    pub named: Packed<Named<'a>, 252>,
}

/// A text and a number.
#[record]
pub(super) struct Named<'a> {
    /// The text.
    pub name: Text<'a>,
    /// Kept.
    pub reserved: Reserved<1>,
}

impl Element for Named<'_> {
    type At<'x> = Named<'x>;
}

/// Reserved bytes, with and without condition.
#[record]
pub(super) struct Optional {
    pub always: Reserved<1>,
    #[wire(when = always.0 != [0])]
    pub sometimes: Option<Reserved<2>>,
}

/// The same as another.
#[message(CMD_CALIB_BAT, outgoing, size = 1..=6)]
pub(super) struct Other(pub Tails);

/// Fields with the names that generated code has for variables.
#[message(CMD_CALIB_OFFSET, outgoing, size = 9..=12)]
pub(super) struct Names {
    /// A name.
    pub input: u8,
    /// A name.
    pub context: u8,
    /// A name.
    pub out: u8,
    /// A name.
    pub place: u8,
    /// A name.
    pub visitor: u8,
    /// A name.
    pub size: u8,
    /// A name.
    pub path: u8,
    /// A name.
    #[wire(counted_by = "COUNT")]
    pub value: List<u8, 2>,
    /// A name.
    #[wire(when = *size & 1 != 0)]
    pub held: Option<u8>,
    /// A name.
    pub ended: Option<u8>,
}

fn bytes<M: Message + super::ToWire>(message: &M) -> heapless::Vec<u8, 255> {
    let mut buffer = [0; 255];
    heapless::Vec::from_slice(message.encode(&mut buffer).unwrap()).unwrap()
}

#[test]
fn tails_end_where_the_payload_ends() {
    let whole = Tails::decode(&[1, 2, 3, 4, 5, 6]).unwrap();
    assert_eq!(whole, Tails { first: 1, second: Some(0x0302), third: Some([4, 5, 6]) });
    assert_eq!(bytes(&whole), [1, 2, 3, 4, 5, 6]);
    assert_eq!(Tails::decode(&[1]).unwrap(), Tails { first: 1, ..Tails::default() });
    assert_eq!(
        Tails::decode(&[]),
        Err(DecodeError::TooShort { command: "CMD_CALIB_ACC", needed: 1, got: 0 })
    );
    assert_eq!(
        Tails::decode(&[1, 2, 3, 4]),
        Err(DecodeError::Truncated {
            command: "CMD_CALIB_ACC",
            field: "THIRD",
            offset: 3,
            needed: 3,
            got: 1
        })
    );
    assert_eq!(Tails::decode_prefix(&[1, 2, 3, 4, 5, 6, 7]).unwrap().1, [7]);
    let gap = Tails { first: 1, second: None, third: Some([0; 3]) };
    assert_eq!(gap.encode(&mut [0; 9]), Err(EncodeError::Gap { field: "THIRD", absent: "SECOND" }));
}

#[test]
fn a_tuple_of_one_is_what_it_holds() {
    assert_eq!(Other::decode(&[1]).unwrap(), Other(Tails { first: 1, ..Tails::default() }));
    assert_eq!(bytes(&Other(Tails { first: 7, ..Tails::default() })), [7]);
}

#[test]
fn conditions_decide_in_both_directions() {
    let payload = [0x83, 1, 2, 3, 0x34, 0x12, 9];
    let message = Conditions::decode(&payload).unwrap();
    assert_eq!(message.low, Some(PerAxis { roll: 1, pitch: 2, yaw: 3 }));
    assert_eq!(message.nested, Some(Nested { wide: Some(0x1234), narrow: 9 }));
    assert_eq!(bytes(&message), payload);
    assert_eq!(Conditions::decode(&[2, 9]).unwrap().nested, Some(Nested { wide: None, narrow: 9 }));

    let missing = Conditions { flags: 1, ..Conditions::default() };
    assert_eq!(missing.encode(&mut [0; 9]), Err(EncodeError::Presence { field: "LOW", expected: true }));
    let surplus = Conditions { low: Some(PerAxis::default()), ..Conditions::default() };
    assert_eq!(surplus.encode(&mut [0; 9]), Err(EncodeError::Presence { field: "LOW", expected: false }));
}

#[test]
fn fields_may_have_any_name() {
    let payload = [1, 2, 3, 4, 5, 7, 6, 1, 9, 10, 11];
    let message = Names::decode(&payload).unwrap();
    assert_eq!((message.size, message.held, message.ended), (7, Some(10), Some(11)));
    assert_eq!(bytes(&message), payload);
}

#[test]
fn lists_count_in_every_way() {
    let payload = [2, 0, 16, 0, 32, 3, 2, b'A', b'B', 7, 0, 8];
    let (message, rest) = Lists::decode_prefix(&payload).unwrap();
    assert_eq!(&message.counted[..], [Angle(4096), Angle(8192)]);
    assert_eq!(message.named.len(), 2);
    assert_eq!(message.named.get(0).unwrap().name.as_str(), Ok("AB"));
    assert!(rest.is_empty());
    assert_eq!(bytes(&message), payload);

    let cut = Lists::decode(&[3, 0, 16]);
    let expected =
        DecodeError::Truncated { command: "CMD_CALIB_MAG", field: "COUNTED", offset: 3, needed: 2, got: 0 };
    assert_eq!(cut, Err(expected));
    assert!(Lists::decode(&[5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]).is_err(), "more than the list holds");
}

#[cfg(feature = "reflect")]
mod reflection {
    use super::*;
    use crate::reflect::{self, Input};
    use crate::wire::{FixedText, Float};

    fn leaves<T: reflect::Describe>(message: &T) -> Vec<String> {
        let mut leaves = Vec::new();
        reflect::walk(message, &mut |leaf: &reflect::Leaf<'_>| {
            leaves.push(format!("{}@{}+{} {}", leaf.path, leaf.offset, leaf.size, leaf.field.spec));
        });
        leaves
    }

    #[test]
    fn every_leaf_has_its_place() {
        let payload = [2, 0, 16, 0, 32, 3, 2, b'A', b'B', 7, 0, 8];
        let message = Lists::decode(&payload).unwrap();
        assert_eq!(
            leaves(&message),
            [
                "num@0+1 NUM",
                "counted[0]@1+2 COUNTED",
                "counted[1]@3+2 COUNTED",
                "most@5+1 MOST",
                "named[0].name@6+3 NAME",
                "named[0].reserved@9+1 RESERVED",
                "named[1].name@10+1 NAME",
                "named[1].reserved@11+1 RESERVED",
            ]
        );
    }

    #[test]
    fn fields_of_any_name_are_found() {
        let mut message = Names::default();
        for path in ["size", "path", "value[0]"] {
            reflect::set(&mut message, path, Input::Raw(1)).unwrap();
        }
        let leaves = leaves(&message);
        assert_eq!(leaves[6], "path@6+1 PATH");
        assert_eq!(leaves[8], "value[0]@8+1 VALUE");
    }

    #[test]
    fn reserved_bytes_are_marked_where_they_are_optional_too() {
        let reflect::Shape::Struct(fields) = <Optional as reflect::Describe>::SHAPE else { panic!() };
        assert!(fields.iter().all(|field| field.reserved));
    }

    #[test]
    fn fields_are_set_by_path() {
        let mut message = Lists::default();
        for (path, value) in [
            ("counted[0]", Input::Text("0")),
            ("counted[1]", Input::Text("45 deg")),
            ("most", Input::Raw(8)),
            ("NAMED[0].name", Input::Text("hello")),
            ("named[0].reserved", Input::Text("05")),
        ] {
            reflect::set(&mut message, path, value).unwrap();
        }
        assert_eq!(bytes(&message), [2, 0, 0, 0, 8, 8, 5, b'h', b'e', b'l', b'l', b'o', 5]);
        reflect::set(&mut message, "num", Input::Raw(0)).unwrap();
        assert_eq!(message.counted.len(), 0);
    }

    #[test]
    fn what_cannot_be_set_is_explained_and_changes_nothing() {
        let mut message = Lists::default();
        reflect::set(&mut message, "named[0].name", Input::Text("hello")).unwrap();
        for (path, value, expected) in [
            ("mist", Input::Raw(1), "unknown field; available: num, counted, most, named"),
            ("counted[4]", Input::Raw(1), "no such element; the only valid index is [0]"),
            ("counted[0]", Input::Text("721"), "out of range; expected -720 to 719.978 deg"),
            ("counted[0]", Input::Raw(40_000), "out of range; expected -720 to 719.978 deg"),
            ("num", Input::Raw(200), "too many elements; maximum 4"),
            ("most", Input::Text("300"), "out of range; expected 0 to 255"),
            ("most", Input::Text("1.5"), "the field cannot hold this value exactly; expected a whole number"),
            ("most", Input::Value(1.5), "the field cannot hold this value exactly; expected a whole number"),
            ("most", Input::Text("few"), "expected a number"),
            ("most", Input::Text("8 (9)"), "the value and the one in parentheses differ"),
            ("most.more", Input::Raw(1), "this field has no parts"),
            ("named[1].name", Input::Raw(1), "expected bytes or text, got a number"),
            ("named[0].name", Input::Text(r#""a\x41""#), "expected a text without escapes"),
            ("named[0].reserved", Input::Text("0z"), "expected bytes as pairs of hex digits"),
            ("named[0].reserved", Input::Text("0102"), "expected 1 bytes, got 2"),
        ] {
            let before = message.clone();
            let error = reflect::set(&mut message, path, value).unwrap_err();
            assert_eq!(error.to_string(), expected, "{path}");
            assert_eq!(message, before, "{path}");
        }
    }

    #[test]
    fn floats_are_exact_or_refused() {
        let set = |text| {
            let mut float = Float::default();
            reflect::set(&mut float, "", Input::Text(text)).map(|()| float.bits())
        };
        for (text, bits) in [
            ("0.1", 0.1_f32.to_bits()),
            ("-0", 0x8000_0000),
            ("inf", f32::INFINITY.to_bits()),
            ("-inf", f32::NEG_INFINITY.to_bits()),
            ("NaN", f32::NAN.to_bits()),
            ("0x7fa00001", 0x7FA0_0001),
            ("NaN (0x7fa00001)", 0x7FA0_0001),
            ("3.4028235e38", f32::MAX.to_bits()),
        ] {
            assert_eq!(set(text).unwrap(), bits, "{text}");
        }
        for text in ["1e39", "-1e39", "1e-60", "0x100000000", "1 (0x7fa00001)"] {
            assert!(set(text).is_err(), "{text}");
        }
        let error = set("1e39").unwrap_err().to_string();
        assert_eq!(error, "out of range; expected -3.4028234663852886e38 to 3.4028234663852886e38");
    }

    #[test]
    fn texts_hold_any_bytes() {
        for bytes in
            [&b""[..], b"plain", b"\"quoted\"", b"a\0b", b"\xFF\xC3\xA9", "gr\u{fc}n \u{202e}".as_bytes()]
        {
            for shown in [reflect::Quoted(bytes).to_string(), reflect::Plain(bytes).to_string()] {
                let mut out = [0; 64];
                assert_eq!(reflect::text_bytes(&shown, &mut out).unwrap(), bytes, "{shown}");
                let mut text = FixedText::<64>::default();
                reflect::set(&mut text, "", Input::Text(&shown)).unwrap();
                assert_eq!(text.0[..bytes.len()], *bytes, "{shown}");
            }
        }
        assert_eq!(reflect::Plain(b"plain").to_string(), "plain");
        assert_eq!(reflect::Quoted(b"\xE9\n").to_string(), r#""\xe9\n""#);
        for text in [r#""\q""#, r#""\x4""#, r#""\u{110000}""#, r#""a"b""#] {
            assert!(reflect::text_bytes(text, &mut [0; 9]).is_err(), "{text}");
        }
    }
}

mod packed {
    use super::*;
    use crate::commands::{DebugVarInfo, DebugVarKind};
    use crate::wire::{FromWire, Writer};

    const NAMED: &[u8] = b"\x02ab\x07\x01\x02";

    fn list<const N: usize>(input: &[u8]) -> (Packed<DebugVarInfo<'static>, N>, &[u8]) {
        let (rest, list) = FromWire::read(input, ()).unwrap();
        (list, rest)
    }

    #[test]
    fn elements_are_read_when_asked_for() {
        let input = [NAMED, b"\0\x01\0\0", b"\x05cut"].concat();
        let (packed, rest) = list::<254>(&input);
        assert_eq!((packed.len(), rest), (2, &b"\x05cut"[..]));
        assert_eq!(packed.as_bytes(), &input[..10]);
        let first = packed.get(0).unwrap();
        assert_eq!(
            (first.var_name.0, first.var_type, first.reserved.0),
            (&b"ab"[..], DebugVarKind(7), [1, 2])
        );
        assert_eq!(packed.get(1).unwrap().var_name.0, b"");
        assert!(packed.get(2).is_none());
        assert_eq!(packed.iter().collect::<Packed<DebugVarInfo<'_>, 254>>(), packed);
    }

    #[test]
    fn what_has_no_room_is_left_over() {
        let input = [NAMED, NAMED].concat();
        let (packed, rest) = list::<11>(&input);
        assert_eq!((packed.len(), rest), (1, NAMED));
        let mut full = packed.clone();
        let element = packed.get(0).unwrap();
        let error = full.push(&element).unwrap_err();
        assert!(matches!(error, EncodeError::BufferTooSmall { capacity: 11, .. }), "{error}");
        assert_eq!(full, packed);
        assert_eq!([element, element].into_iter().collect::<Packed<DebugVarInfo<'_>, 11>>().len(), 1);
        assert_eq!(list::<11>(&[]), (Packed::new(), &[][..]));
    }

    #[test]
    fn a_count_limits_both_directions() {
        let input = [NAMED, NAMED].concat();
        let (rest, packed) = Packed::<DebugVarInfo<'_>, 254>::read_at_most(1, "vars", &input, ()).unwrap();
        assert_eq!((packed.len(), rest), (1, NAMED));
        let mut out = [0; 20];
        let mut writer = Writer::new(&mut out);
        assert!(packed.write_at_most(0, "vars", (), &mut writer).is_err());
        packed.write_at_most(1, "vars", (), &mut writer).unwrap();
        assert_eq!(writer.len(), NAMED.len());
    }
}
