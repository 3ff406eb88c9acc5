//! What the board keeps.

use sbgc_proto::commands::{
    Confirm, ConfirmData, EepromRead, EepromReadRequest, EepromWrite, Params3, ProfileId, ProfileNames,
    ReadParams3, ReadParamsExt, ReadProfileNames, UseDefaults, WriteProfileNames,
};
use sbgc_proto::wire::FixedText;
use sbgc_proto::{CommandId, Message};

use super::{Bench, ms};
use crate::sim::{Config, StoredBlock};

#[test]
fn blocks_keep_every_byte() {
    let mut bench = Bench::new(Config { profile: 3, ..Config::default() });
    for (read, write, length) in [(21, 22, 134), (33, 34, 104), (62, 63, 151), (104, 105, 221)] {
        for fill in [0x00, 0x55, 0xFF] {
            let mut block = vec![fill; length];
            block[0] = 2;
            bench.send_raw(write, &block);
            let got = bench.run(ms(8));
            assert_eq!(got[0].decoded::<Confirm>().cmd_id, CommandId::from(write));
            bench.send_raw(read, &[2]);
            let got = bench.run(ms(8)).remove(0);
            assert_eq!(got.id, read);
            // The selected sensor and the active profile are the board's to say.
            if read == 21 {
                block[132] = 1;
                block[133] = 3;
            }
            assert_eq!(got.payload, block);
        }
    }
    bench.send_raw(22, &[0; 133]);
    assert_eq!(bench.run(ms(8)), [], "a body of another size is ignored");
}

#[test]
fn profiles_are_apart() {
    let mut bench = Bench::new(Config { profile: 4, ..Config::default() });
    let p = |bench: &mut Bench, profile| {
        let block = bench.ask_one(&ReadParams3 { profile_id: ProfileId::from(profile) });
        let block = block.decoded::<Params3>();
        assert_eq!(block.cur_profile_id, ProfileId::Profile5);
        (block.profile_id.raw(), block.motors.roll.p.0)
    };
    let seen: Vec<_> = (0..5).map(|profile| p(&mut bench, profile)).collect();
    assert_eq!(seen, [(0, 30), (1, 31), (2, 32), (3, 33), (4, 34)]);
    assert_eq!(p(&mut bench, 255), (4, 34));
    assert_eq!(bench.ask_one(&ReadParamsExt { profile_id: ProfileId::Current }).payload[0], 4);
}

#[test]
fn parameters_can_be_given() {
    let block = StoredBlock { id: ReadParamsExt::ID, profile: 1, payload: vec![9; 104] };
    let short = StoredBlock { id: ReadParamsExt::ID, profile: 2, payload: vec![9; 10] };
    let mut bench = Bench::new(Config { parameters: vec![block, short], ..Config::default() });
    let second = |bench: &mut Bench, profile: u8| {
        bench.ask_one(&ReadParamsExt { profile_id: profile.into() }).payload[1]
    };
    assert_eq!([second(&mut bench, 1), second(&mut bench, 2)], [9, 40]);
}

#[test]
fn the_eeprom_is_read_by_pages() {
    let mut bench = Bench::new(Config::default());
    let data = [0xA5; 128];
    let got = bench.ask_one(&EepromWrite { addr: 32 * 1024 - 128, data: &data });
    assert_eq!(got.decoded::<Confirm>().data, ConfirmData::U16(32 * 1024 - 128));
    let got = bench.ask_one(&EepromReadRequest { addr: 32 * 1024 - 192, size: 192 });
    let read = got.decoded::<EepromRead<'_>>();
    assert_eq!((read.data.len(), read.data[63], read.data[64]), (192, 0xFF, 0xA5));
    for (addr, size) in [(0, 0), (0, 63), (1, 64), (0, 256), (32 * 1024, 64), (u32::MAX - 63, 64)] {
        let got = bench.ask_one(&EepromReadRequest { addr, size });
        assert_eq!(got.payload[..2], [48, 10], "{addr} {size}");
    }
}

#[test]
fn names_and_defaults() {
    let mut bench = Bench::new(Config::default());
    let mut names = bench.ask_one(&ReadProfileNames {}).decoded::<ProfileNames>();
    assert_eq!(names.profile_name[4].as_str(), Ok("Profile 5"));
    names.profile_name[0] = FixedText([0xE9; 48]);
    bench.ask_one(&WriteProfileNames(names.clone()));
    assert_eq!(bench.ask_one(&ReadProfileNames {}).decoded::<ProfileNames>(), names);

    let second = |bench: &mut Bench| bench.ask_one(&ReadParams3 { profile_id: ProfileId::Profile2 });
    let factory = second(&mut bench);
    bench.send_raw(22, &[1; 134]);
    bench.run(ms(8));
    assert_ne!(second(&mut bench), factory);
    bench.ask_one(&UseDefaults { profile_id: ProfileId::Profile2 });
    assert_eq!(second(&mut bench), factory);
    bench.ask_one(&UseDefaults { profile_id: ProfileId::EraseEeprom });
    bench.run(ms(8));
    assert_eq!(bench.board.resets(), 1);
}
