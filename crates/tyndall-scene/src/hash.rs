//! One number for everything that the picture depends on.

use std::fmt;

use crate::Scene;

/// Hash of a scene's parameters: equal for scenes that give the same picture on the same adapter, and the same on every
/// operating system. Title and description do not count. Displayed as hexadecimal; `{:.16}` is enough for file headers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SceneHash([u8; 32]);

impl SceneHash {
    /// Hash of the canonical text: a line `group.key=value` per parameter, in the order of declaration.
    pub(crate) fn of(scene: &Scene) -> Self {
        let mut hasher = blake3::Hasher::new();
        hasher.update(b"tyndall scene 1\n");
        for (group, set) in scene.groups() {
            for (index, info) in set.info().iter().enumerate() {
                // Adding zero turns -0 into 0, which is equal to it.
                let value = info.format(set.get(index) + 0.0);
                hasher.update(format!("{group}.{}={value}\n", info.name).as_bytes());
            }
            for (index, info) in set.text_info().iter().enumerate() {
                hasher.update(format!("{group}.{}={}\n", info.name, set.text(index)).as_bytes());
            }
        }
        Self(*hasher.finalize().as_bytes())
    }

    /// The 32 bytes.
    #[must_use]
    pub fn as_bytes(&self) -> &[u8; 32] {
        &self.0
    }
}

impl fmt::Display for SceneHash {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(&blake3::Hash::from_bytes(self.0).to_hex())
    }
}
