//! NumPy's archive of arrays: `numpy.load("run.npz")["position"]` has the shape (samples, bodies, 3).

use std::io::{self, Cursor};

use npyz::WriterBuilder;
use npyz::npz::NpzWriter;
use npyz::zip::write::FileOptions;

use super::arrays;
use crate::trajectory::Trajectory;

pub(super) fn write(run: &Trajectory) -> io::Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    let mut archive = NpzWriter::new(&mut bytes);
    for array in arrays(run).map_err(io::Error::other)? {
        let shape: Vec<u64> = array.shape.iter().map(|&n| n as u64).collect();
        let mut writer = archive.array(array.name, FileOptions::default())?.default_dtype().shape(&shape).begin_nd()?;
        writer.extend(array.data)?;
        writer.finish()?;
    }
    drop(archive);
    Ok(bytes.into_inner())
}
