//! Bytes as the storage commands show and compare them.

use crate::output::Output;

/// Hex digits as `hexdump` shows them: sixteen bytes per line, after their address.
pub(super) fn dump(output: &mut Output, address: u32, data: &[u8]) -> std::io::Result<()> {
    for (line, bytes) in data.chunks(16).enumerate() {
        let at = u64::from(address) + line as u64 * 16;
        let pairs: Vec<String> = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        output.line(format_args!("{at:08x}  {}", pairs.join(" ")))?;
    }
    Ok(())
}

/// How many bytes differ, and where the first does.
pub(super) fn differences(before: &[u8], after: &[u8]) -> (usize, Option<usize>) {
    let longer = before.len().max(after.len());
    let mut differing = (0..longer).filter(|&index| before.get(index) != after.get(index));
    let first = differing.next();
    (first.map_or(0, |_| 1 + differing.count()), first)
}
